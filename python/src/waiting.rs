//! Long computations without the interpreter lock: other threads run, and Ctrl-C is handled.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use lcplab::solver::Stop;
use pyo3::prelude::*;

/// The interval for checking whether the user wants to stop.
const PAUSE: Duration = Duration::from_millis(50);

/// An exception of the user's function that ends its caller: KeyboardInterrupt, SystemExit.
static INTERRUPT: Mutex<Option<PyErr>> = Mutex::new(None);

/// Records an exception of the user's function that ends its caller.
pub fn interrupt(error: PyErr) {
    *INTERRUPT.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
}

/// Whether the current computation must end.
pub fn is_interrupted() -> bool {
    INTERRUPT.lock().unwrap_or_else(PoisonError::into_inner).is_some()
}

fn interrupted() -> Option<PyErr> {
    INTERRUPT.lock().unwrap_or_else(PoisonError::into_inner).take()
}

/// Runs a short computation without the interpreter lock; returns the exception that ended it.
pub fn quickly<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let result = py.detach(work);
    interrupted().map_or(Ok(result), Err)
}

/// Runs a computation on another thread, without the interpreter lock, until it is done or stopped.
/// In a browser there are no threads, so that it cannot be stopped.
pub fn wait<T: Send>(py: Python<'_>, stop: &Stop, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    if cfg!(target_os = "emscripten") {
        return quickly(py, work);
    }
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
