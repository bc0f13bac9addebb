//! Signals that end the program: no draft of a file is left behind.
//!
//! TERM, Ctrl-C (INT), HUP and QUIT remove the drafts and then end the program as they always do, so that whoever waits for it sees
//! the signal. KILL, and a machine that stops, cannot be caught. Systems other than Unix have no such signals.

/// Sees to it that a signal that ends the program removes the drafts of files first.
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

    /// Sees to it that a signal that ends the program removes the drafts of files first.
    pub fn remove_drafts_at_the_end() {
        static ONCE: Once = Once::new();
        ONCE.call_once(|| {
            let ends = [SIGTERM, SIGINT, SIGHUP, SIGQUIT];
            let ends = ends.into_iter().filter(|signal| !is_ignored(*signal));
            // Without handlers files are written all the same.
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

    /// True if whoever started the program had it ignore `signal`, as `nohup` does with HUP: that stays so.
    ///
    /// Only Linux tells. Elsewhere HUP counts as ignored, so that `nohup` works.
    fn is_ignored(signal: i32) -> bool {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
        mask.map_or(signal == SIGHUP, |mask| mask >> (signal - 1) & 1 == 1)
    }
}
