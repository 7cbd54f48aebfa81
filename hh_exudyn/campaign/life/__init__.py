"""The life of wheels: from the rates of a load collective to profiles over the distance, step by step.

    campaign = Campaign.begin("campaign.toml", "folder")
    with ProcessWorkers() as workers:
        campaign.run(workers, distance=150e6)
    campaign.histories()["leading outer"].to_table()

=================  ==================================================================================
`groups`           wheels that wear alike: by axle, by role in curves, or each by itself
`plan`             a campaign's file: the load collective, and tables for wheels, damage, steps
`template`         the text of a new campaign's file
`rates`            wear and crack rates of a group from the sums of weighted cases
`profiles`         profiles as files under the hash of their points
`reuse`            cases that need not run again, as no wheel has moved where it touches
`evaluation`       rates for the profiles of all groups, with a record of the results taken
`wheels`           wheels over a step: cracks, turning at a limit
`rails`            wear and fatigue of the rails by curve class, per gross tonne
`errors`           errors of sampling and of the steps of axes, at one state of the wheels
`steps`            the wheels after every step on disk
`stored_rows`      rates of the cases of the last evaluation, as they lie on disk
`campaign`         `Campaign`: the folder, and the loop
=================  ==================================================================================
"""
