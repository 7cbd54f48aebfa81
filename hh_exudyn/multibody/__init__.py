"""The only importer of Exudyn: vehicle and track descriptions become a multibody system and are run.

===================  ==========================================================================="""

try:
    import exudyn as _exudyn  # noqa: F401
except ImportError as error:
    raise ImportError(
        f"Exudyn cannot be loaded: {error}. On a machine without a desktop, install the OpenGL library (on "
        "Debian: apt-get install libgl1)"
    ) from error
