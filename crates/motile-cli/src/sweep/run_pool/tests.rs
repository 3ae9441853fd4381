use super::*;
use anyhow::ensure;
use std::fs;

#[test]
fn finished_runs_are_kept_and_spoilt_or_failed_ones_made_again() {
    let directory = std::env::temp_dir().join(format!("motile-pool-{}", std::process::id()));
    let runs = AtomicUsize::new(0);
    let jobs: Vec<u32> = (0..7).collect();
    let go = |fails: u32| {
        let pool = RunPool::new(&directory, 3, true).unwrap();
        let results = pool.run(
            &jobs,
            |job| format!("job_{job}"),
            |&job| {
                runs.fetch_add(1, Ordering::Relaxed);
                ensure!(job != fails, "job {job} does not work");
                let mut summary = Summary::default();
                summary.put("square", job * job, "");
                Ok(summary)
            },
        );
        let count = runs.swap(0, Ordering::Relaxed);
        (results, count)
    };
    let (results, count) = go(3);
    assert_eq!(count, 7);
    assert_eq!(format!("{:#}", results[3].as_ref().unwrap_err()), "job_3: job 3 does not work");
    assert!(results.iter().enumerate().all(|(k, r)| k == 3 || r.as_ref().unwrap().number("square") == (k * k) as f64));

    // Cut short, not JSON, JSON of something else, that of another run.
    let file = |k: usize| directory.join(format!("job_{k}.json"));
    let whole = fs::read_to_string(file(0)).unwrap();
    fs::write(file(0), &whole[..whole.len() / 2]).unwrap();
    fs::write(file(1), "").unwrap();
    fs::write(file(2), "[1, 2]").unwrap();
    fs::copy(file(5), file(6)).unwrap();
    let (results, count) = go(100);
    assert_eq!(count, 5);
    assert!(results.iter().enumerate().all(|(k, r)| r.as_ref().unwrap().number("square") == (k * k) as f64));
    assert_eq!(go(100).1, 0);

    // Of another version, and of a time before there were any.
    let written = fs::read_to_string(file(0)).unwrap();
    fs::write(file(0), written.replace(motile::VERSION, "0.0.9+1")).unwrap();
    let unmarked = fs::read_to_string(file(1)).unwrap().replace("motile_version", "another_entry");
    fs::write(file(1), unmarked).unwrap();
    assert_eq!((go(100).1, go(100).1), (2, 0));
    let said = made_again(&file(0), Some("0.0.9+1"));
    assert!(said.contains("was written by motile 0.0.9+1, and this is motile"), "{said}");
    fs::remove_dir_all(&directory).unwrap();
}
