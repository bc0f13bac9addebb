//! Pixel formats, and the fields in which colours add up.
//!
//! A colour is three fields of one `u32`. So two loads and one addition add a highlight to all
//! three channels:
//!
//! ```text
//! bit  31     30 … 21   20     19 … 11   10      9      8 … 0
//!      guard  green     guard  red       unused  guard  blue
//! ```
//!
//! A field holds a channel's integer, then its fraction. When a sum passes the top of a field, it
//! sets the field's guard bit, and [`saturate`] fills the field. Tables include ½, so that cutting
//! the fraction rounds.

/// The guard bits of all three fields.
const GUARDS: u32 = 1 << 31 | 1 << 20 | 1 << 9;

/// A pixel format, into which spans and triangles are shaded.
///
/// Implement it for the format of your display:
///
/// ```
/// use fastphong::integer::Pixel;
///
/// /// 3 bits of red, 3 of green, 2 of blue.
/// #[derive(Clone, Copy)]
/// struct Rgb332(u8);
///
/// impl Pixel for Rgb332 {
///     const BITS: [u32; 3] = [3, 3, 2];
///
///     fn from_fields(fields: u32) -> Self {
///         // The top 3 bits of green and red, and the top 2 of blue.
///         let (red, green, blue) = (fields >> 17 & 7, fields >> 28 & 7, fields >> 7 & 3);
///         Self((red << 5 | green << 2 | blue) as u8)
///     }
/// }
/// assert_eq!(Rgb332::from_fields(0x7FEF_F9FF).0, 0xFF);
/// ```
pub trait Pixel: Copy {
    /// How many bits red, green and blue have: at most 9, 10 and 9.
    const BITS: [u32; 3];

    /// Returns the pixel of a colour in fields: green in bits 21–30, red in 11–19, blue in 0–8. The
    /// top [`Pixel::BITS`] of each field are the channel, and the rest is a fraction to cut. All
    /// other bits are 0.
    fn from_fields(fields: u32) -> Self;

    /// Returns the pixel of a colour in halves: red in bits 16–31 of `red_blue`, blue in its bits
    /// 0–15, and green in bits 0–15 of `green`. The top [`Pixel::BITS`] of each half are the
    /// channel, and the rest is a fraction to cut. Other bits of `green` may have any value.
    /// Gouraud shading adds in this form.
    #[inline(always)]
    fn from_halves(red_blue: u32, green: u32) -> Self {
        Self::from_fields(
            (red_blue >> 12 & 0x000F_F800) | (green << 15 & 0x7FE0_0000) | (red_blue >> 7 & 0x1FF),
        )
    }
}

/// A pixel of 24 bits: red, green and blue of 8 bits each, in this order in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(transparent)]
pub struct Rgb888(pub [u8; 3]);

/// A pixel of 16 bits in the processor's byte order: from the top, 5 bits of red, 6 of green and 5
/// of blue.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(transparent)]
pub struct Rgb565(pub u16);

/// A pixel like [`Rgb565`] with its high byte first, the order in which most displays read pixels
/// over SPI.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(transparent)]
pub struct Rgb565Be(pub u16);

impl Pixel for Rgb888 {
    const BITS: [u32; 3] = [8; 3];

    #[inline(always)]
    fn from_fields(fields: u32) -> Self {
        Self([
            (fields >> 12) as u8,
            (fields >> 23) as u8,
            (fields >> 1) as u8,
        ])
    }
    #[inline(always)]
    fn from_halves(red_blue: u32, green: u32) -> Self {
        Self([
            (red_blue >> 24) as u8,
            (green >> 8) as u8,
            (red_blue >> 8) as u8,
        ])
    }
}

impl Pixel for Rgb565 {
    const BITS: [u32; 3] = [5, 6, 5];

    #[inline(always)]
    fn from_fields(fields: u32) -> Self {
        // After the shift red and blue are in place, and green is 16 bits too high.
        let cut = fields >> 4 & 0x07E0_F81F;
        Self((cut | cut >> 16) as u16)
    }
    #[inline(always)]
    fn from_halves(red_blue: u32, green: u32) -> Self {
        Self(((red_blue >> 16 & 0xF800) | (green >> 5 & 0x07E0) | (red_blue >> 11 & 0x1F)) as u16)
    }
}

impl Pixel for Rgb565Be {
    const BITS: [u32; 3] = Rgb565::BITS;

    #[inline(always)]
    fn from_fields(fields: u32) -> Self {
        Self(Rgb565::from_fields(fields).0.to_be())
    }
    #[inline(always)]
    fn from_halves(red_blue: u32, green: u32) -> Self {
        Self(Rgb565::from_halves(red_blue, green).0.to_be())
    }
}

/// The lowest bit and the width of each channel's field: red, green and blue.
const PLACES: [(u32, u32); 3] = [(11, 9), (21, 10), (0, 9)];

/// Returns the fields of channels that have 16 fractional bits. Channels are clamped to 1, and the
/// ½ that rounds is not included.
pub(super) const fn fields<P: Pixel>(channels: [u64; 3]) -> u32 {
    let mut sum = 0;
    let mut i = 0;
    while i < 3 {
        let (at, width) = PLACES[i];
        let clamped = if channels[i] < 1 << 16 {
            channels[i]
        } else {
            1 << 16
        };
        // The channel's largest integer, with zeros as the fraction: 1.0 must not round up.
        let top = ((1 << P::BITS[i]) - 1) << (width - P::BITS[i]);
        sum |= ((clamped * top + (1 << 15)) >> 16 << at) as u32;
        i += 1;
    }
    sum
}

/// Returns ½ in all three fields, or 0 where a field has no fraction.
pub(super) const fn half<P: Pixel>() -> u32 {
    const {
        let [red, green, blue] = P::BITS;
        let is_fit = red <= 9 && green <= 10 && blue <= 9;
        assert!(is_fit, "at most 9, 10 and 9 bits");
    }
    let mut sum = 0;
    let mut i = 0;
    while i < 3 {
        let (at, width) = PLACES[i];
        sum |= (1 << (width - P::BITS[i]) >> 1) << at;
        i += 1;
    }
    sum
}

/// Fills each field whose guard bit is set, and clears the guards.
#[inline(always)]
pub(super) fn saturate(sum: u32) -> u32 {
    let over = sum & GUARDS;
    // Most sums stay below 1 and need no more.
    if over == 0 {
        return sum;
    }
    // A guard minus 2⁻⁹ of itself is nine ones below it. They fill a field, except green's lowest
    // bit, which is a fraction in all formats of this file.
    (sum | (over - (over >> 9))) - over
}

/// Returns a colour in halves of 16 bits, red and blue first, then green: see
/// [`Pixel::from_halves`].
#[inline(always)]
pub(super) fn halves(fields: u32) -> (u32, u32) {
    let red_blue = (fields << 12 & 0xFF80_0000) | (fields << 7 & 0xFF80);
    (red_blue, fields >> 15 & 0xFFC0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_black_and_each_channel_arrive_in_every_format() {
        let one = 1 << 16;
        for (channels, full, short) in [
            ([0; 3], [0, 0, 0], 0),
            ([one; 3], [255; 3], 0xFFFF),
            ([one, 0, 0], [255, 0, 0], 0xF800),
            ([0, one, 0], [0, 255, 0], 0x07E0),
            ([0, 0, one], [0, 0, 255], 0x001F),
            ([5 * one; 3], [255; 3], 0xFFFF),
        ] {
            let full_fields = fields::<Rgb888>(channels) + half::<Rgb888>();
            let short_fields = fields::<Rgb565>(channels) + half::<Rgb565>();
            assert_eq!(Rgb888::from_fields(full_fields), Rgb888(full));
            assert_eq!(Rgb565::from_fields(short_fields), Rgb565(short));
            assert_eq!(
                Rgb565Be::from_fields(short_fields).0.to_ne_bytes(),
                short.to_be_bytes()
            );
            let (red_blue, green) = halves(full_fields);
            assert_eq!(Rgb888::from_halves(red_blue, green), Rgb888(full));
            let (red_blue, green) = halves(short_fields);
            assert_eq!(Rgb565::from_halves(red_blue, green), Rgb565(short));
        }
    }

    #[test]
    fn every_level_survives_fields_and_halves() {
        for level in 0..256u64 {
            let channels = [level, 255 - level, level ^ 85].map(|x| (x * 65536 + 127) / 255);
            let expected = [level, 255 - level, level ^ 85].map(|x| x as u8);
            let fields = fields::<Rgb888>(channels) + half::<Rgb888>();
            assert_eq!(Rgb888::from_fields(fields), Rgb888(expected));
            let (red_blue, green) = halves(fields);
            assert_eq!(Rgb888::from_halves(red_blue, green), Rgb888(expected));
        }
    }

    #[test]
    fn sums_past_the_top_fill_their_field_and_no_other() {
        let white = fields::<Rgb565>([1 << 16; 3]) + half::<Rgb565>();
        let most = saturate(white + fields::<Rgb565>([1 << 16; 3]));
        assert_eq!(Rgb565::from_fields(most), Rgb565(0xFFFF));
        assert_eq!(most & (GUARDS | 1 << 10), 0);
        let red = fields::<Rgb565>([1 << 16, 0, 0]) + half::<Rgb565>();
        assert_eq!(
            Rgb565::from_fields(saturate(red + red)),
            Rgb565(0xF800 | 1 << 5 | 1)
        );
    }
}
