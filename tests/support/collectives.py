"""Files of load collectives of other designs than the template's."""

from hh_exudyn.campaign.collective import template_text


def product_text(
    design: str = "overlay", vehicle: str = "iore_wagon_pair", quantiles: int = 3, replicates: int = 3
) -> str:
    """The template with cells of the product of few steps, in place of points in one of many."""
    text = template_text("malmbanan", vehicle)
    changes = {
        'kind = "sampled"\nruns = 20\n': f'kind = "{design}"\n',
        "halvings = { radius = 1, quality = 1 }\n": "",
        "quantiles = 8": f"quantiles = {quantiles}",
        "replicates = 3": f"replicates = {replicates}",
    }
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new)
    return text
