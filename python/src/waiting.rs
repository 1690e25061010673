//! Long work beside an interpreter that goes on: other threads run, and Ctrl-C is heard.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use lcplab::solver::Stop;
use pyo3::prelude::*;

/// How often it is looked whether someone wants to stop.
const PAUSE: Duration = Duration::from_millis(50);

/// What a function of the user's raised to end more than itself: KeyboardInterrupt, SystemExit.
static INTERRUPT: Mutex<Option<PyErr>> = Mutex::new(None);

/// Notes that a function of the user's ends what called it.
pub fn interrupt(error: PyErr) {
    *INTERRUPT.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
}

/// Whether what is under way is to end.
pub fn is_interrupted() -> bool {
    INTERRUPT.lock().unwrap_or_else(PoisonError::into_inner).is_some()
}

fn interrupted() -> Option<PyErr> {
    INTERRUPT.lock().unwrap_or_else(PoisonError::into_inner).take()
}

/// Does short work without the interpreter; returns what a function of the user's raised to end it.
pub fn quickly<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let result = py.detach(work);
    interrupted().map_or(Ok(result), Err)
}

/// Does the work on another thread, without the interpreter, until it is done or the user stops it.
pub fn wait<T: Send>(py: Python<'_>, stop: &Stop, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let mut asked = None;
    let result = py.detach(|| {
        thread::scope(|scope| {
            let (done, is_done) = channel();
            let worker = scope.spawn(move || {
                let result = work();
                let _ = done.send(());
                result
            });
            while let Err(RecvTimeoutError::Timeout) = is_done.recv_timeout(PAUSE) {
                let heard = Python::attach(|py| py.check_signals().err()).or_else(interrupted);
                if let Some(error) = heard {
                    stop.raise();
                    asked = Some(error);
                }
            }
            worker.join()
        })
    });
    let late = interrupted();
    match (asked.or(late), result) {
        (Some(error), _) => Err(error),
        (None, Ok(result)) => Ok(result),
        (None, Err(_)) => {
            Err(pyo3::exceptions::PyRuntimeError::new_err("lcplab failed: please report this"))
        }
    }
}
