"""From cases to damage sums, over any executor of ``concurrent.futures``; results are files, never lost.

    work = CaseWork(case, parts=(Part("curve", 120.0, 220.0),))
    tasks = [case_task(work, "R 305-400", weight=0.3), ...]
    with ResultFolder("results", "malmbanan", code()) as folder, ProcessWorkers() as workers:
        report = evaluate_all(tasks, evaluate_case, folder, workers)
        curve = weighted_sum(tasks, folder)["curve"]

=============  ==================================================================================
`sums`         `DamageSums`: surfaces of all wheels of a run, and its largest forces; as bytes
`case_damage`  `evaluate_case`: simulate a case, sum its damage, keep nothing else
`task`         `Task`: what is to be evaluated, under its key; `Evaluated`: what a worker gives back
`workers`      processes, a Dask cluster, or any executor: submit, and begin anew after a death
`results`      the folder of results: whole, checked, of one campaign and one code; failures too
`cost`         wall time of a case, from what has run; time left, timeouts, other numbers of cores
`mapping`      `evaluate_all`: the loop; what dies or hangs runs again elsewhere
=============  ==================================================================================
"""
