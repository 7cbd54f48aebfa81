"""``python -m hh_exudyn`` is the command ``hh-exudyn``."""

from hh_exudyn.cli.app import main

if __name__ == "__main__":
    main()
