"""The numbers of damage: ``damage/data/<name>.toml``, read by `hh_exudyn.sourced`."""

from hh_exudyn.sourced import Parameter, load_parameters


def table_names(name: str) -> tuple[str, ...]:
    """The tables of ``damage/data/<name>.toml``."""
    return load_parameters("damage", name).tables


def parameters(name: str, table: str) -> dict[str, Parameter]:
    """The parameters of a table of ``damage/data/<name>.toml``, by quantity.

    Raises
    ------
    ValueError
        No such table (the message has those there are), or an entry without a proper source.
    """
    return {item.name: item for item in load_parameters("damage", name).table(table).parameters}
