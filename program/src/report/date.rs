//! Dates.

use alloc::format;
use alloc::string::String;

/// Returns the day `seconds` after 1970-01-01 00:00 UTC, like `2000-02-29`, in the proleptic
/// Gregorian calendar.
///
/// It counts eras of 400 years, which have 146,097 days, and years that begin in March, so that the
/// leap day comes last (Hinnant 2014, *chrono-Compatible Low-Level Date Algorithms*,
/// `civil_from_days`).
pub fn utc_date(seconds: u64) -> String {
    // There are 719,468 days from 0000-03-01 to 1970-01-01.
    let days = seconds / 86_400 + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    // Remove leap days, so that every year of the era has 365 days.
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day_of_year = day - (365 * year + year / 4 - year / 100);
    // From March on, every five months have 153 days.
    let month = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 {
        (month + 3, 0)
    } else {
        (month - 9, 1)
    };
    format!("{:04}-{month:02}-{day:02}", era * 400 + year + next)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_those_of_the_calendar() {
        // date -u -d @N +%F
        for (seconds, date) in [
            (0, "1970-01-01"),
            (86_399, "1970-01-01"),
            (86_400, "1970-01-02"),
            (68_169_600, "1972-02-29"),
            (68_256_000, "1972-03-01"),
            (951_782_400, "2000-02-29"),
            (951_868_800, "2000-03-01"),
            (1_735_689_599, "2024-12-31"),
            (4_107_542_400, "2100-03-01"),
            (4_107_456_000, "2100-02-28"),
        ] {
            assert_eq!(utc_date(seconds), date);
        }
    }
}
