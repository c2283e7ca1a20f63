"""Modelica in, FMU out.

``pipeline.build`` shows every stage in order; ``python -m fmu_build`` is its command line. The package knows Modelica,
C and FMI, and nothing of any particular model.
"""
