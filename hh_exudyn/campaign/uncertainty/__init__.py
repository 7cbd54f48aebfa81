"""Bands of life and wear from what is assumed in a campaign, without new runs.

    life = FastLife(Campaign("folder"))
    found = study(life, life.assumptions.varied, samples=100)
    uncertainty_figure(found)

=================  ==================================================================================
`assumptions`      numbers with ranges that are varied, and those that are not, with the reason
`case_weights`     weights of the cases for other shares of seasons, runnings, hauls
`film_wear`        wear of the cases where films of lubricant take off more or less
`fast_life`        from values of the assumptions to the life of every group of wheels
`importance`       Morris and Sobol, by SALib (extra ``studies``)
`study`            bands, and the assumptions that matter most
`tables`           both as tables
`figure`           both as a figure
=================  ==================================================================================
"""
