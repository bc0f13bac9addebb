//! Results in JSON: any text is refused with a message, or shown as a page, as Markdown and as
//! tables.

use fastphong_cli::report::Report;

/// Longer texts are skipped, because they only repeat what shorter ones have.
const MOST_BYTES: usize = 1 << 16;

pub fn run(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else {
        return;
    };
    if text.len() > MOST_BYTES {
        return;
    }
    let mut report = match Report::read(text.to_owned()) {
        Ok(report) => report,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            return;
        }
    };
    report.lay_beside(report.clone());
    report.csv();
    report.markdown("images");
    report.html();
}
