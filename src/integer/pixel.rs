//! Formats of pixels, and the fields that colours are summed in.
//!
//! A colour is three fields of one `u32`, so that two loads and one addition add a highlight to all
//! three channels:
//!
//! ```text
//! bit  31     30 … 21   20     19 … 11   10      9      8 … 0
//!      guard  green     guard  red       unused  guard  blue
//! ```
//!
//! A field holds a channel's integer, then its fraction. A guard bit is set when a sum passes the
//! top of its field: [`saturate`] then fills the field. Tables include ½, so that cutting the
//! fraction rounds.

/// The guard bits of all three fields.
const GUARDS: u32 = 1 << 31 | 1 << 20 | 1 << 9;

/// A format of pixels that spans are shaded in.
pub trait Pixel: Copy {
    /// The bits of red, green and blue: at most 9, 10 and 9.
    const BITS: [u32; 3];

    /// Returns the pixel of a colour in fields: green in bits 21–30, red in 11–19, blue in 0–8, each
    /// an integer of [`Pixel::BITS`] above a fraction to cut. All other bits are 0.
    fn from_fields(fields: u32) -> Self;

    /// Returns the pixel of a colour in halves: red in bits 16–31 of the first, blue in its bits
    /// 0–15, green in bits 0–15 of the second, each an integer of [`Pixel::BITS`] above a fraction.
    /// Other bits of `green` may be anything. Gouraud shading adds in this form.
    #[inline(always)]
    fn from_halves(red_blue: u32, green: u32) -> Self {
        Self::from_fields(
            (red_blue >> 12 & 0x000F_F800) | (green << 15 & 0x7FE0_0000) | (red_blue >> 7 & 0x1FF),
        )
    }
}

/// Red, green and blue of 8 bits each, in this order in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(transparent)]
pub struct Rgb888(pub [u8; 3]);

/// Red of 5 bits, green of 6, blue of 5, from the top of a `u16` in the processor's byte order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(transparent)]
pub struct Rgb565(pub u16);

/// As [`Rgb565`], in big-endian bytes: the order in which most displays take them over SPI.
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
        // Green, red and blue are where they belong, but for 16 bits of green.
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

/// The place of each channel in a colour: its lowest bit and its width, for red, green and blue.
const PLACES: [(u32, u32); 3] = [(11, 9), (21, 10), (0, 9)];

/// Returns fields of channels in 16 fractional bits, clamped to 1, without the ½ that rounds.
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
        // The largest integer of the channel, with the fraction below it.
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
    if over == 0 {
        return sum;
    }
    // A guard less 2⁻⁹ of itself is nine ones below it: all of a field, but for the lowest bit of green.
    (sum | (over - (over >> 9))) - over
}

/// Returns red and blue, then green, in halves of 16 bits: see [`Pixel::from_halves`].
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
