//! Removes the drafts of files when a signal ends the program.
//!
//! On TERM, INT (Ctrl-C), HUP and QUIT, the program removes the drafts and then ends by the
//! signal's default action, so that its parent process sees the signal. KILL cannot be caught, and
//! neither can a machine that stops. Systems other than Unix do not have these signals.

/// Does nothing: this system has no signals to handle.
#[cfg(not(unix))]
pub fn remove_drafts_at_the_end() {}

#[cfg(unix)]
pub use unix::remove_drafts_at_the_end;

#[cfg(unix)]
mod unix {
    use fastphong::picture::image_file::remove_drafts;
    use signal_hook::consts::signal::{SIGHUP, SIGINT, SIGQUIT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;
    use std::sync::Once;
    use std::thread;

    /// Starts a thread that removes the drafts of files when a signal ends the program. Further
    /// calls do nothing.
    pub fn remove_drafts_at_the_end() {
        static ONCE: Once = Once::new();
        ONCE.call_once(|| {
            let ends = [SIGTERM, SIGINT, SIGHUP, SIGQUIT];
            let ends = ends.into_iter().filter(|signal| !is_ignored(*signal));
            // If the handlers cannot be installed, files are still written.
            if let Ok(mut signals) = Signals::new(ends) {
                thread::spawn(move || {
                    for signal in signals.forever() {
                        let _none = remove_drafts();
                        let _ = emulate_default_handler(signal);
                    }
                });
            }
        });
    }

    /// True if the program was started with `signal` ignored, as `nohup` does with HUP. It must
    /// then stay ignored.
    ///
    /// Only Linux reports this. On other systems HUP counts as ignored, so that `nohup` works.
    fn is_ignored(signal: i32) -> bool {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
        mask.map_or(signal == SIGHUP, |mask| mask >> (signal - 1) & 1 == 1)
    }
}
