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
            return match self.storage.channels {
                Channels::Bgr => [levels[2], levels[1], levels[0]],
                _ => levels,
            };
        }
        let stored = [r, g, b].map(|c| self.stored(c));
        let mean = stored.iter().sum::<f64>() / 3.0;
        let [r, g, b] = stored;
        let channels = match self.storage.channels {
            Channels::Rgb => [r, g, b],
            Channels::Bgr => [b, g, r],
            Channels::Grey => [mean; 3],
        };
        channels.map(|c| self.level(c) as f32)
    }

    /// Returns the linear light that this conversion stores as a level.
    pub fn decoded(&self, level: f64) -> f64 {
        let c = level / 255.0;
        match self.curve {
            Curve::Stated | Curve::Linear => c,
            Curve::Srgb => Encoding::Srgb.decode(c),
            Curve::SrgbTwice => Encoding::Srgb.decode(Encoding::Srgb.decode(c)),
            Curve::Decoded => Encoding::Srgb.encode(c),
            Curve::Power => libm::pow(c, 2.2),
            Curve::InversePower => libm::pow(c, 1.0 / 2.2),
        }
    }

    /// True if the crate's own encoder computes the same levels, which is faster.
    fn is_plain_srgb(&self) -> bool {
        self.curve == Curve::Srgb
            && self.storage.rounding == Rounding::Nearest
            && self.storage.channels != Channels::Grey
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
            Rounding::Of256 if self.is_wrapped() => libm::floor(256.0 * stored),
            Rounding::Of256 => libm::floor(256.0 * stored).min(255.0),
        };
        if self.is_wrapped() {
            level % 256.0
        } else {
            level
        }
    }
}
