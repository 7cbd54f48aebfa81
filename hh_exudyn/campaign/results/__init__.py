"""What a campaign has found: tables, figures and one page, from its folder alone; nothing is run.

    recorded = Recorded.of(Campaign("folder"))
    measures_table(recorded), over_distance_figure(recorded)
    Path("campaign.html").write_text(page(recorded))

=============  ======================================================================================
`recorded`     `Recorded`: the steps, and the rates of the cases of the last evaluation
`tables`       measures, running-in, wear by place, cracks by place and band, rails, steps, failed cases
`shares`       shares of curve classes, loads, seasons in the damage
`lives`        turnings, and a forecast of the next one
`errors`       errors of the rates, where they were evaluated
`inputs`       numbers with sources and ranges, limits, settings
`figures`      figures of one campaign
`comparison`   two campaigns beside each other
`html_parts`   tables that sort at a click, figures inside a page
`page`         the page
=============  ======================================================================================
"""
