//! The threads that draw pictures.

use pyo3::PyResult;
use pyo3::exceptions::PyOSError;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::process;
use std::sync::{Arc, Mutex, PoisonError};

/// Runs `work` on this process's pool of threads.
///
/// A forked process, as `multiprocessing` makes on Linux, has none of its parent's threads. Rayon's
/// own pool would wait for them for ever. So each process makes its own pool when it first draws.
pub fn install<R: Send>(work: impl FnOnce() -> R + Send) -> PyResult<R> {
    Ok(pool()?.install(work))
}

fn pool() -> PyResult<Arc<ThreadPool>> {
    static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);
    let mut pool = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((process, pool)) = &*pool
        && *process == process::id()
    {
        return Ok(pool.clone());
    }
    let made = ThreadPoolBuilder::new().build();
    let made = made.map_err(|error| PyOSError::new_err(error.to_string()))?;
    let made = Arc::new(made);
    // Dropping the parent's pool would wait for threads that do not exist here.
    std::mem::forget(pool.replace((process::id(), made.clone())));
    Ok(made)
}
