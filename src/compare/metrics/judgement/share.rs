//! Shares of pixels: how many may be over a threshold, and how many are.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use core::fmt;

/// The largest number of decimals of a percentage.
const DECIMALS: usize = 9;

/// How many pixels may be over a threshold: a number, or a percentage of the compared pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Allowance {
    /// The text that it was read from.
    text: String,
    most: Most,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Most {
    Pixels(u64),
    /// In units of 10⁻⁹ %, so that decimals are exact: 0.3 is not a float.
    Percentage(u64),
}

impl Allowance {
    /// Reads a number of pixels, or a percentage from `0%` to `100%` with at most nine decimals.
    pub fn parse(text: &str) -> Option<Allowance> {
        let most = match text.strip_suffix('%') {
            Some(number) => Most::Percentage(percentage(number)?),
            None => Most::Pixels(text.parse().ok()?),
        };
        let text = text.to_owned();
        Some(Allowance { text, most })
    }

    /// True if `over` of `compared` pixels may be over the threshold.
    pub fn allows(&self, over: usize, compared: usize) -> bool {
        match self.most {
            Most::Pixels(most) => over as u64 <= most,
            Most::Percentage(most) => {
                let whole = 10u128.pow(DECIMALS as u32 + 2);
                over as u128 * whole <= u128::from(most) * compared as u128
            }
        }
    }
}

impl fmt::Display for Allowance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// Reads a decimal number from 0 to 100, in units of 10⁻⁹.
fn percentage(text: &str) -> Option<u64> {
    let (whole, decimals) = text.split_once('.').unwrap_or((text, ""));
    let is_number = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
    let is_short = whole.len() <= 3 && decimals.len() <= DECIMALS;
    if !is_number(whole) || !is_number(decimals) || !is_short || whole.len() + decimals.len() == 0 {
        return None;
    }
    let units: u64 = format!("{whole}{decimals:0<DECIMALS$}").parse().ok()?;
    (units <= 100 * 10u64.pow(DECIMALS as u32)).then_some(units)
}

/// Writes a share of pixels in percent. Only 0 is written as 0, and only all pixels as 100.
pub fn share_text(pixels: usize, all: usize) -> String {
    let share = match all {
        0 => 0.0,
        all => 100.0 * pixels as f64 / all as f64,
    };
    match share {
        share if pixels > 0 && share < 0.01 => "under 0.01 %".to_owned(),
        share if pixels < all && share > 99.99 => "over 99.99 %".to_owned(),
        share => format!("{share:.2} %"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn allowances_count_as_they_are_written() {
        let allows = |text: &str, over, compared| {
            let allowance = Allowance::parse(text).expect(text);
            allowance.allows(over, compared)
        };
        for (text, most, compared) in [
            ("0", 0, 1000),
            ("7", 7, 1000),
            ("18446744073709551615", 1 << 28, 1 << 28),
            ("0%", 0, 1000),
            ("0.1%", 1, 1000),
            (".1%", 1, 1000),
            ("0.3%", 3, 1000),
            ("0.7%", 7, 1000),
            ("0.000000373%", 1, 1 << 28),
            ("33.333333333%", 999, 3000),
            ("100%", 1000, 1000),
            ("100.0%", 1000, 1000),
        ] {
            assert!(allows(text, most, compared), "{text} allows {most}");
            let allows_more = most < compared && allows(text, most + 1, compared);
            assert!(!allows_more, "{text} allows more than {most}");
        }
        for text in [
            "",
            "%",
            ".%",
            "-1",
            "1.5",
            "1e3",
            "100.1%",
            "0.0000000001%",
            "1 %",
            "x",
            "+1%",
        ] {
            assert_eq!(Allowance::parse(text), None, "{text}");
        }
    }

    #[test]
    fn a_share_is_not_rounded_to_none_or_all() {
        let all = 1 << 28;
        let shown = [(0, 0), (0, 9), (1, all), (1, 3), (all - 1, all), (9, 9)]
            .map(|(pixels, all)| share_text(pixels, all));
        let expected = [
            "0.00 %",
            "0.00 %",
            "under 0.01 %",
            "33.33 %",
            "over 99.99 %",
            "100.00 %",
        ];
        assert_eq!(shown, expected);
    }
}
