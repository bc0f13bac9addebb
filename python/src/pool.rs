//! The threads that work, and the caller that waits for them.

use pyo3::PyResult;
use pyo3::Python;
use pyo3::exceptions::PyOSError;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::process;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How long the caller waits before it looks for signals again.
const PATIENCE: Duration = Duration::from_millis(50);

/// Runs `work` on this process's pool of threads, without Python's lock. If a signal makes Python
/// raise an exception, as Ctrl-C does, this returns at once: nobody waits for the result any more,
/// and threads that are still busy with it do not hold up later work.
///
/// `work` must not use Python, and owns what it needs, because it may outlive the call.
pub fn run<R: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> R + Send + 'static,
) -> PyResult<R> {
    let (sender, mut receiver) = channel();
    pool()?.spawn(move || {
        let result = catch_unwind(AssertUnwindSafe(work));
        // If the caller was interrupted, nobody receives the result.
        let _ = sender.send(result);
    });
    loop {
        let waiting = &mut receiver;
        match py.detach(move || waiting.recv_timeout(PATIENCE)) {
            Ok(Ok(result)) => return Ok(result),
            Ok(Err(panic)) => resume_unwind(panic),
            Err(RecvTimeoutError::Timeout) => py.check_signals().inspect_err(|_| {
                // The next call makes another pool.
                locked(&POOL).take();
            })?,
            Err(RecvTimeoutError::Disconnected) => {
                unreachable!("the sender sends before it is dropped")
            }
        }
    }
}

/// The pool, and the process that it belongs to.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// Locks `mutex`. Call it only while the thread holds Python's lock, and do not release that lock
/// before this one. A thread that forks holds Python's lock, so the child then finds every mutex
/// free.
pub fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Returns this process's pool.
///
/// A forked process, as `multiprocessing` makes on Linux, has none of its parent's threads. Rayon's
/// own pool would wait for them for ever. So each process makes its own pool when it first works.
fn pool() -> PyResult<Arc<ThreadPool>> {
    let mut pool = locked(&POOL);
    if let Some((process, pool)) = &*pool
        && *process == process::id()
    {
        return Ok(pool.clone());
    }
    let made = ThreadPoolBuilder::new().build();
    let made = made.map_err(|error| PyOSError::new_err(error.to_string()))?;
    // Waits until all threads run. What they set up for the whole process must be complete before
    // a thread that waits for Python's lock forks.
    made.broadcast(|_| ());
    let made = Arc::new(made);
    // Dropping the parent's pool would wait for threads that do not exist here.
    std::mem::forget(pool.replace((process::id(), made.clone())));
    Ok(made)
}
