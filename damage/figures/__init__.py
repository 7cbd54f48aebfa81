"""Figures of damage, as papers show them. They need no display: matplotlib's own Figure is used.

====================================  ==============================================================="""
