//! The instruction sets of the pixel loops. One of them is chosen at run time.

use super::NameError;
use alloc::borrow::ToOwned;
use core::fmt;
use core::str::FromStr;

/// An instruction set for which the pixel loops are compiled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum SimdLevel {
    /// One pixel at a time, in plain `f32`: the same bits on every platform.
    #[default]
    Scalar,
    /// 256-bit registers, 8 floats, with fused multiply-add (x86-64-v3).
    Avx2,
    /// 512-bit registers, 16 floats, with fused multiply-add (x86-64-v4).
    Avx512,
    /// 128-bit registers, 4 floats, with fused multiply-add (64-bit ARM).
    Neon,
}

impl SimdLevel {
    /// All instruction sets, from the narrowest up; `Neon` is last.
    pub const ALL: [SimdLevel; 4] = [
        SimdLevel::Scalar,
        SimdLevel::Avx2,
        SimdLevel::Avx512,
        SimdLevel::Neon,
    ];

    /// Returns the best instruction set of this machine. The word `auto` stands for it.
    pub fn best() -> SimdLevel {
        SimdLevel::available().last().unwrap_or_default()
    }

    /// Returns the instruction sets of this machine, the best one last.
    pub fn available() -> impl Iterator<Item = SimdLevel> + Clone {
        SimdLevel::ALL
            .into_iter()
            .filter(|level| level.is_available())
    }

    /// True if this machine has the instruction set. Without the feature `simd`, only
    /// [`SimdLevel::Scalar`] is available.
    pub fn is_available(self) -> bool {
        match self {
            SimdLevel::Scalar => true,
            #[cfg(all(feature = "simd", target_arch = "x86_64"))]
            SimdLevel::Avx2 => fearless_simd::Level::new().as_avx2().is_some(),
            #[cfg(all(feature = "simd", target_arch = "x86_64"))]
            SimdLevel::Avx512 => fearless_simd::Level::new().as_avx512().is_some(),
            #[cfg(all(feature = "simd", target_arch = "aarch64"))]
            SimdLevel::Neon => fearless_simd::Level::new().as_neon().is_some(),
            #[allow(unreachable_patterns)] // the rest depends on the platform
            _ => false,
        }
    }

    /// Returns how many pixels are shaded at a time. NEON and AVX2 take two registers for them.
    pub fn width(self) -> usize {
        match self {
            SimdLevel::Scalar => 1,
            SimdLevel::Neon => 8,
            SimdLevel::Avx2 | SimdLevel::Avx512 => 16,
        }
    }

    /// Returns the name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            SimdLevel::Scalar => "scalar",
            SimdLevel::Avx2 => "avx2",
            SimdLevel::Avx512 => "avx512",
            SimdLevel::Neon => "neon",
        }
    }

    /// Returns a description: one phrase for help texts.
    pub fn title(self) -> &'static str {
        match self {
            SimdLevel::Scalar => "one pixel at a time, the same bits on every platform",
            SimdLevel::Avx2 => {
                "16 pixels at a time in registers of 8, with fused multiply-add (x86-64-v3)"
            }
            SimdLevel::Avx512 => {
                "16 pixels at a time in registers of 16, with fused multiply-add (x86-64-v4)"
            }
            SimdLevel::Neon => {
                "8 pixels at a time in registers of 4, with fused multiply-add (64-bit ARM)"
            }
        }
    }
}

impl fmt::Display for SimdLevel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for SimdLevel {
    type Err = NameError;

    /// Parses the name of an instruction set of this machine, or `auto` for the best one.
    fn from_str(name: &str) -> Result<SimdLevel, NameError> {
        if name == "auto" {
            return Ok(SimdLevel::best());
        }
        let named = SimdLevel::ALL
            .into_iter()
            .find(|level| level.name() == name);
        if let Some(level) = named.filter(|level| level.is_available()) {
            return Ok(level);
        }
        let available = core::iter::once("auto")
            .chain(SimdLevel::available().map(SimdLevel::name))
            .collect();
        Err(match named {
            Some(level) => NameError::NotOnThisMachine { level, available },
            None => NameError::Unknown {
                kind: "instruction set",
                name: name.to_owned(),
                known: available,
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;

    #[test]
    fn names_are_read_as_they_are_written() {
        for level in SimdLevel::ALL {
            match level.name().parse::<SimdLevel>() {
                Ok(read) => assert!(read == level && level.is_available()),
                Err(_) => assert!(!level.is_available()),
            }
            assert_eq!(level.to_string(), level.name());
        }
        assert_eq!("auto".parse(), Ok(SimdLevel::best()));
    }

    #[test]
    fn one_pixel_at_a_time_is_always_there() {
        let mut available = SimdLevel::available();
        assert_eq!(available.next(), Some(SimdLevel::Scalar));
        assert!(available.all(|level| level != SimdLevel::Scalar));
        assert!(SimdLevel::best().is_available());
        #[cfg(not(feature = "simd"))]
        assert_eq!(SimdLevel::best(), SimdLevel::Scalar);
    }

    #[test]
    fn what_is_no_level_is_said_to_be_none() {
        // No processor has both.
        let other = if cfg!(target_arch = "x86_64") {
            SimdLevel::Neon
        } else {
            SimdLevel::Avx2
        };
        let text = other.name().parse::<SimdLevel>().unwrap_err().to_string();
        assert!(
            text.starts_with("this machine does not have `")
                && SimdLevel::available().all(|level| text.contains(&alloc::format!("`{level}`"))),
            "{text}"
        );
        let text = "scaler".parse::<SimdLevel>().unwrap_err().to_string();
        assert_eq!(
            text,
            "unknown instruction set `scaler`: did you mean `scalar`?"
        );
        let text = "".parse::<SimdLevel>().unwrap_err().to_string();
        assert!(
            text.starts_with("unknown instruction set ``: expected ")
                && text.contains("`auto`")
                && text.contains("`scalar`"),
            "{text}"
        );
    }
}
