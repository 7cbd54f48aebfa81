"""The front of `hh_exudyn.contact.tangential.kalker`: creep coefficients of the linear theory."""

from hh_exudyn.contact.tangential.kalker import kalker_coefficients

__all__ = ["kalker_coefficients"]
