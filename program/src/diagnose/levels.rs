//! Converts linear light to the levels of a file, correctly or with mistakes.

use super::recipe::{Channels, Curve, LevelRange, Rounding, Storage};
use fastphong::picture::Encoding;
use fastphong::picture::encoding::Encoder;
use glam::DVec3;

/// A conversion from colours to levels of 0..=255.
pub struct Levels {
    storage: Storage,
    curve: Curve,
    /// The factor of colours, 1 unless they are [stretched](Self::is_stretched).
    pub scale: f64,
}

impl Levels {
    /// Makes the conversion of `storage` for a scene with `encoding`.
    pub fn new(storage: Storage, encoding: Encoding) -> Levels {
        let stated = match encoding {
            Encoding::Linear => Curve::Linear,
            Encoding::Srgb => Curve::Srgb,
        };
        Levels {
            storage,
            curve: match storage.curve {
                Curve::Stated => stated,
                curve => curve,
            },
            scale: 1.0,
        }
    }

    /// True if all colours are divided by the largest one. Then set [`Levels::scale`].
    pub fn is_stretched(&self) -> bool {
        self.storage.range == LevelRange::Stretched
    }

    /// Returns the levels of a colour.
    pub fn of(&self, colour: DVec3) -> [f32; 3] {
        let colour = match self.storage.range {
            LevelRange::ByLargest => colour / colour.max_element().max(1.0),
            LevelRange::ToneMapped => colour / (DVec3::ONE + colour.max(DVec3::ZERO)),
            _ => colour * self.scale,
        };
        let [r, g, b] = colour.to_array();
        if self.is_plain_srgb() {
            let levels = [r, g, b].map(|c| f32::from(Encoder::srgb().level(c as f32)));
            return self.exchanged(levels);
        }
        let stored = [r, g, b].map(|c| self.stored(c));
        let mean = stored.iter().sum::<f64>() / 3.0;
        let channels = match self.storage.channels {
            Channels::Grey => [mean; 3],
            _ => self.exchanged(stored),
        };
        let levels = channels.map(|c| self.level(c) as f32);
        match self.storage.channels {
            Channels::GreyOfLevels => [libm::floorf(levels.iter().sum::<f32>() / 3.0); 3],
            _ => levels,
        }
    }

    fn exchanged<T>(&self, channels: [T; 3]) -> [T; 3] {
        Levels::exchanged_of(self.storage, channels)
    }

    /// Returns the channels in the order in which they are stored.
    pub fn exchanged_of<T>(storage: Storage, [r, g, b]: [T; 3]) -> [T; 3] {
        match storage.channels {
            Channels::Rgb | Channels::Grey | Channels::GreyOfLevels => [r, g, b],
            Channels::Bgr => [b, g, r],
            Channels::Grb => [g, r, b],
            Channels::Rbg => [r, b, g],
        }
    }

    /// Returns the linear light that this conversion stores as a level.
    pub fn decoded(&self, level: f64) -> f64 {
        // The middle of the interval that is stored as this level.
        let c = match self.storage.rounding {
            Rounding::Nearest => level / 255.0,
            Rounding::Down => (level + 0.5) / 255.0,
            Rounding::Up => (level - 0.5) / 255.0,
            Rounding::Of256 | Rounding::Of256Wrapped => (level + 0.5) / 256.0,
        };
        let c = match self.curve {
            Curve::Stated | Curve::Linear => c,
            Curve::Srgb => Encoding::Srgb.decode(c),
            Curve::SrgbTwice => Encoding::Srgb.decode(Encoding::Srgb.decode(c)),
            Curve::Decoded => Encoding::Srgb.encode(c),
            Curve::Power => libm::pow(c, 2.2),
            Curve::InversePower => libm::pow(c, 1.0 / 2.2),
        };
        match self.storage.range {
            LevelRange::ToneMapped => c / (1.0 - c).max(1e-3),
            _ => c,
        }
    }

    /// True if the crate's own encoder computes the same levels, which is faster.
    fn is_plain_srgb(&self) -> bool {
        self.curve == Curve::Srgb
            && self.storage.rounding == Rounding::Nearest
            && !matches!(
                self.storage.channels,
                Channels::Grey | Channels::GreyOfLevels
            )
            && !self.is_wrapped()
    }

    fn is_wrapped(&self) -> bool {
        self.storage.range == LevelRange::Wrapped
    }

    /// Returns a channel after the curve.
    fn stored(&self, c: f64) -> f64 {
        let most = if self.is_wrapped() {
            f64::INFINITY
        } else {
            1.0
        };
        let c = c.clamp(0.0, most);
        match self.curve {
            Curve::Stated | Curve::Linear => c,
            Curve::Srgb => Encoding::Srgb.encode(c),
            Curve::SrgbTwice => Encoding::Srgb.encode(Encoding::Srgb.encode(c)),
            Curve::Decoded => Encoding::Srgb.decode(c),
            Curve::Power => libm::pow(c, 1.0 / 2.2),
            Curve::InversePower => libm::pow(c, 2.2),
        }
    }

    fn level(&self, stored: f64) -> f64 {
        let level = match self.storage.rounding {
            Rounding::Nearest => libm::floor(255.0 * stored + 0.5),
            Rounding::Down => libm::floor(255.0 * stored),
            Rounding::Up => libm::ceil(255.0 * stored),
            Rounding::Of256 if !self.is_wrapped() => libm::floor(256.0 * stored).min(255.0),
            Rounding::Of256 => libm::floor(256.0 * stored),
            Rounding::Of256Wrapped => libm::floor(256.0 * stored) % 256.0,
        };
        if self.is_wrapped() {
            level % 256.0
        } else {
            level
        }
    }
}
