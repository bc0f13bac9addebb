//! Instruction sets of the pixel loops, one of which is chosen at run time.

use super::NameError;
use super::suggest::{one_of, unknown};
use alloc::format;
use core::fmt;
use core::str::FromStr;

/// An instruction set that pixel loops are compiled for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// One pixel at a time, in plain `f32`: the same bits on every platform.
    #[default]
    Scalar,
    /// Registers of 256 bits, 8 numbers, with fused multiplication and addition (x86-64-v3).
    Avx2,
    /// Registers of 512 bits, 16 numbers, with fused multiplication and addition (x86-64-v4).
    Avx512,
    /// Registers of 128 bits, 4 numbers, with fused multiplication and addition (64-bit ARM).
    Neon,
}

impl Level {
    /// All levels, from the least to the most.
    pub const ALL: [Level; 4] = [Level::Scalar, Level::Avx2, Level::Avx512, Level::Neon];

    /// Returns the best level of this machine, which `auto` takes.
    pub fn best() -> Level {
        Level::available().last().unwrap_or_default()
    }

    /// Returns the levels that this machine has, from the least to the most.
    pub fn available() -> impl Iterator<Item = Level> + Clone {
        Level::ALL.into_iter().filter(|level| level.is_available())
    }

    /// True if this machine has it. Without the feature `simd` there is only [`Level::Scalar`].
    pub fn is_available(self) -> bool {
        match self {
            Level::Scalar => true,
            #[cfg(all(feature = "simd", target_arch = "x86_64"))]
            Level::Avx2 => fearless_simd::Level::new().as_avx2().is_some(),
            #[cfg(all(feature = "simd", target_arch = "x86_64"))]
            Level::Avx512 => fearless_simd::Level::new().as_avx512().is_some(),
            #[cfg(all(feature = "simd", target_arch = "aarch64"))]
            Level::Neon => fearless_simd::Level::new().as_neon().is_some(),
            #[allow(unreachable_patterns)] // the rest depends on the platform
            _ => false,
        }
    }

    /// Returns the number of pixels that are shaded at a time.
    pub fn width(self) -> usize {
        match self {
            Level::Scalar => 1,
            Level::Neon => 8,
            Level::Avx2 | Level::Avx512 => 16,
        }
    }

    /// Returns its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Level::Scalar => "scalar",
            Level::Avx2 => "avx2",
            Level::Avx512 => "avx512",
            Level::Neon => "neon",
        }
    }

    /// Describes it in one sentence.
    pub fn title(self) -> &'static str {
        match self {
            Level::Scalar => "one pixel at a time, the same bits on every platform",
            Level::Avx2 => "registers of 8 pixels, with fused multiply-add (x86-64-v3)",
            Level::Avx512 => "registers of 16 pixels, with fused multiply-add (x86-64-v4)",
            Level::Neon => "registers of 4 pixels, with fused multiply-add (64-bit ARM)",
        }
    }
}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Level {
    type Err = NameError;

    /// Reads the name of a level of this machine, or `auto` for the best one.
    fn from_str(name: &str) -> Result<Level, NameError> {
        let here = core::iter::once("auto").chain(Level::available().map(Level::name));
        let problem = match Level::ALL.into_iter().find(|level| level.name() == name) {
            _ if name == "auto" => return Ok(Level::best()),
            Some(level) if level.is_available() => return Ok(level),
            Some(level) => format!("this machine does not have `{level}`: {}", one_of(here)),
            None => unknown("instruction set", name, here),
        };
        Err(NameError(problem))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn names_are_read_as_they_are_written() {
        for level in Level::ALL {
            match level.name().parse::<Level>() {
                Ok(read) => assert!(read == level && level.is_available()),
                Err(_) => assert!(!level.is_available()),
            }
            assert_eq!(level.to_string(), level.name());
        }
        assert_eq!("auto".parse(), Ok(Level::best()));
    }

    #[test]
    fn one_pixel_at_a_time_is_always_there() {
        let mut available = Level::available();
        assert_eq!(available.next(), Some(Level::Scalar));
        assert!(available.all(|level| level != Level::Scalar));
        assert!(Level::best().is_available());
        #[cfg(not(feature = "simd"))]
        assert_eq!(Level::best(), Level::Scalar);
    }

    #[test]
    fn what_is_no_level_is_said_to_be_none() {
        // No processor has both.
        let other = if cfg!(target_arch = "x86_64") {
            Level::Neon
        } else {
            Level::Avx2
        };
        let text = other.name().parse::<Level>().unwrap_err().to_string();
        assert!(
            text.starts_with("this machine does not have `")
                && Level::available().all(|level| text.contains(&format!("`{level}`"))),
            "{text}"
        );
        let text = "scaler".parse::<Level>().unwrap_err().to_string();
        assert_eq!(
            text,
            "unknown instruction set `scaler`: did you mean `scalar`?"
        );
        let text = "".parse::<Level>().unwrap_err().to_string();
        assert!(
            text.starts_with("unknown instruction set ``: expected ")
                && text.contains("`auto`")
                && text.contains("`scalar`"),
            "{text}"
        );
    }
}
