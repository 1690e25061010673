//! Sweeps: what a file says, what is planned, how it is run, and what closed forms say of the
//! results.

mod file;
mod folder;
mod study;
mod theory;

use lcplab::report::grid::{Finding, Folder, Grid, Task};

/// A grid of a text.
fn grid(text: &str) -> Grid {
    Grid::from_toml("test.toml", text).unwrap()
}

/// Every point of a grid with what was found there.
fn found(text: &str) -> Vec<(Task, Finding)> {
    let (grid, folder) = (grid(text), tempfile::tempdir().unwrap());
    let folder = Folder::new(folder.path(), &grid).unwrap();
    let tasks = folder.plan().tasks.clone();
    let one = |task: Task| {
        let record = folder.run_one(task.task).unwrap();
        assert_eq!(record.reason, None);
        (task, record.finding.unwrap())
    };
    tasks.into_iter().map(one).collect()
}
