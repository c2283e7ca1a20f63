"""One thread is enough: matrices here are tiny, and with more BLAS spends its time waiting for its own threads."""

# What numpy's and SciPy's libraries read when they are loaded.
ONE_THREAD = dict.fromkeys(("MKL_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "1")
