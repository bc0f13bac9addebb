//! The way from light to grey levels.

use crate::options::{Background, Channels, Encoding, Layout, Options, Overflow, Rounding};
use crate::variation::Variation;
use fastphong::picture;
use fastphong::scene::Scene;
use glam::DVec3;

/// A picture as it is stored in a file: red, green, blue and straight alpha, row by row from the
/// top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    pub width: usize,
    pub height: usize,
    pub pixels: Vec<[u8; 4]>,
}

/// The light at each sample; `None` where nothing is drawn.
pub struct Samples {
    pub width: usize,
    pub height: usize,
    pub colours: Vec<Option<DVec3>>,
}

/// Returns the picture of `samples`, with `side` × `side` samples per pixel.
pub fn picture(
    scene: &Scene,
    samples: &Samples,
    side: usize,
    options: &Options,
    variation: &Variation,
) -> Picture {
    let background = match options.background {
        Background::OfScene => DVec3::from_array(scene.background.map(f64::from)),
        Background::Black => DVec3::ZERO,
        Background::White => DVec3::ONE,
    };
    let (width, height) = (samples.width / side, samples.height / side);
    let exposed = exposed(samples, options.overflow);
    let mut pixels = Vec::with_capacity(width * height);
    for y in 0..height {
        for x in 0..width {
            let rows = (y * side..(y + 1) * side).map(|row| row * samples.width + x * side);
            let covered = rows.flat_map(|at| &exposed[at..at + side]).flatten();
            let (sum, count) = covered.fold((DVec3::ZERO, 0), |(sum, n), c| (sum + *c, n + 1));
            let all = (side * side) as f64;
            let (colour, alpha) = if count == 0 {
                (background, if variation.opaque { 1.0 } else { 0.0 })
            } else if variation.opaque {
                let rest = all - f64::from(count);
                ((sum + rest * background) / all, 1.0)
            } else {
                (sum / f64::from(count), f64::from(count) / all)
            };
            pixels.push(store(colour, alpha, options, scene));
        }
    }
    let mut picture = laid_out(
        Picture {
            width,
            height,
            pixels,
        },
        options.layout,
    );
    if variation.dirty {
        add_noise(&mut picture);
    }
    picture
}

/// Returns the samples after the treatment of colours brighter than 1.
fn exposed(samples: &Samples, overflow: Overflow) -> Vec<Option<DVec3>> {
    let colours = samples.colours.iter().flatten();
    let brightest = colours.map(|c| c.max_element()).fold(1e-9, f64::max);
    let expose = |c: DVec3| match overflow {
        Overflow::Clamped => c.clamp(DVec3::ZERO, DVec3::ONE),
        Overflow::Wraps => c,
        Overflow::DividedByBrightest => (c / brightest).clamp(DVec3::ZERO, DVec3::ONE),
        Overflow::DividedByOwnLargest => (c / c.max_element().max(1.0)).max(DVec3::ZERO),
        Overflow::ToneMapped => c.max(DVec3::ZERO) / (DVec3::ONE + c.max(DVec3::ZERO)),
    };
    samples
        .colours
        .iter()
        .map(|colour| colour.map(expose))
        .collect()
}

/// Returns a pixel as it is stored.
fn store(colour: DVec3, alpha: f64, options: &Options, scene: &Scene) -> [u8; 4] {
    let [r, g, b] = colour.to_array().map(|c| {
        let level = encode(c, options.encoding, scene.encoding);
        round(level, options.rounding)
    });
    let alpha = (255.0 * alpha).round() as u8;
    match options.channels {
        Channels::Rgb => [r, g, b, alpha],
        Channels::Bgr => [b, g, r, alpha],
        Channels::Grb => [g, r, b, alpha],
        Channels::Rbg => [r, b, g, alpha],
        Channels::Grey => {
            let grey = ((u16::from(r) + u16::from(g) + u16::from(b)) / 3) as u8;
            [grey, grey, grey, alpha]
        }
    }
}

fn encode(c: f64, wrong: Encoding, of_scene: picture::Encoding) -> f64 {
    let c_or_0 = c.max(0.0);
    match (wrong, of_scene) {
        (Encoding::OfScene, picture::Encoding::Linear) | (Encoding::Linear, _) => c,
        (Encoding::OfScene, picture::Encoding::Srgb) | (Encoding::Srgb, _) => srgb(c),
        (Encoding::Gamma22, _) => c_or_0.powf(1.0 / 2.2),
        (Encoding::SrgbTwice, _) => srgb(srgb(c)),
        (Encoding::Decoded, _) => c_or_0.powf(2.2),
    }
}

/// Returns the sRGB value of an intensity (IEC 61966-2-1).
fn srgb(c: f64) -> f64 {
    if c <= 0.003_130_8 {
        12.92 * c
    } else {
        1.055 * c.powf(1.0 / 2.4) - 0.055
    }
}

/// Returns the grey level of a value. As in C, a value that does not fit into 8 bits loses its
/// upper bits; only `Overflow::Wraps` and `Rounding::Times256` cause that.
fn round(value: f64, rounding: Rounding) -> u8 {
    let level = match rounding {
        Rounding::Nearest => (255.0 * value).round(),
        Rounding::Down => (255.0 * value).floor(),
        Rounding::Times256 => (256.0 * value).floor(),
    };
    (level as i64 & 255) as u8
}

/// Returns the picture with its pixels in another order.
fn laid_out(picture: Picture, layout: Layout) -> Picture {
    let Picture {
        width,
        height,
        pixels,
    } = picture;
    let count = pixels.len();
    let from = |at: usize| {
        let (x, y) = (at % width, at / width);
        match layout {
            Layout::Rows => at,
            Layout::RightToLeft => y * width + (width - 1 - x),
            Layout::HalfTurn => count - 1 - at,
            // Written to x · height + y, read row by row.
            Layout::Columns => (at % height) * width + at / height,
            Layout::OneRowDown => y.saturating_sub(1) * width + x,
            Layout::OneRightAndUp => (y + 1).min(height - 1) * width + x.saturating_sub(1),
            Layout::OneLeftAndDown => y.saturating_sub(1) * width + (x + 1).min(width - 1),
        }
    };
    let pixels = (0..count).map(|at| pixels[from(at)]).collect();
    Picture {
        width,
        height,
        pixels,
    }
}

/// Adds −1, 0 or 1 to each channel but alpha, as a file format with losses might.
fn add_noise(picture: &mut Picture) {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    for pixel in &mut picture.pixels {
        for channel in &mut pixel[..3] {
            // Xorshift (Marsaglia 2003).
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            *channel = match state % 3 {
                0 => channel.saturating_sub(1),
                1 => *channel,
                _ => channel.saturating_add(1),
            };
        }
    }
}
