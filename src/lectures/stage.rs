//! What figures are drawn on: frames of a few polygons whose corners and normals are given.

use super::FigureError;
use crate::frame::{Frame, FrameBuilder, SubPixel, Vertex};
use crate::mesh::Material;
use crate::picture::encoding::store;
use crate::picture::{Encoding, LinearPicture, Picture8};
use crate::scene::input::{load, resolve};
use crate::scene::{HiddenSurfaces, Light, Lighting, Scene};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use glam::DVec3;

/// A corner of a polygon on the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Column and row, in pixels.
    pub place: [f64; 2],
    /// Depth, 0 at the near plane, 1 at the far plane.
    pub depth: f64,
    /// Unit vertex normal.
    pub normal: DVec3,
}

impl Corner {
    /// A corner half-way between near and far plane.
    pub fn new(place: [f64; 2], normal: DVec3) -> Corner {
        Corner {
            place,
            depth: 0.5,
            normal,
        }
    }
}

/// A polygon on the picture.
#[derive(Clone, Debug)]
pub(super) struct Facet {
    /// Its corners in order.
    pub corners: Vec<Corner>,
    /// Its own unit normal, for flat shading.
    pub normal: DVec3,
}

impl Facet {
    /// A polygon that faces the eye.
    pub fn new(corners: impl Into<Vec<Corner>>) -> Facet {
        Facet {
            corners: corners.into(),
            normal: DVec3::Z,
        }
    }
}

/// A grey surface and the one white light on it (L21 2.1).
#[derive(Clone, Copy, Debug)]
pub(super) struct Grey {
    /// Toward the light.
    pub light: DVec3,
    /// I_a k_a.
    pub ambient: f32,
    /// I_p k_d.
    pub diffuse: f32,
    /// I_p k_s.
    pub specular: f32,
    /// The exponent n.
    pub shininess: f32,
}

impl Grey {
    /// A dull white surface: its intensity is L · N.
    pub fn dull(light: DVec3) -> Grey {
        Grey {
            light,
            ambient: 0.0,
            diffuse: 1.0,
            specular: 0.0,
            shininess: 1.0,
        }
    }

    /// As the methods take it, seen from +z.
    pub fn lighting(&self) -> Lighting {
        let material = Material {
            ambient: [self.ambient; 3],
            diffuse: [self.diffuse; 3],
            specular: [self.specular; 3],
            shininess: self.shininess,
        };
        Lighting::new(
            &material,
            [1.0; 3],
            &[Light::directional(self.light.normalize(), [1.0; 3])],
            DVec3::Z,
        )
    }
}

/// A frame of `polygons`, drawn in this order and all seen.
///
/// # Errors
/// If a coordinate is beyond the guard band, or the size is not one.
pub(super) fn frame(
    [width, height]: [u32; 2],
    grey: &Grey,
    polygons: &[Facet],
) -> Result<Frame, FigureError> {
    let mut builder = FrameBuilder::new(width, height);
    builder.hidden_surfaces(HiddenSurfaces::DrawOrder);
    let material = builder.lighting(grey.lighting());
    for (number, facet) in polygons.iter().enumerate() {
        let vertex = |corner: &Corner| Vertex {
            x: SubPixel::from_num(corner.place[0]),
            y: SubPixel::from_num(corner.place[1]),
            depth: corner.depth as f32,
            inv_w: 1.0,
            normal: corner.normal.as_vec3().to_array(),
            material,
        };
        let numbers: Vec<u32> = facet
            .corners
            .iter()
            .map(|corner| builder.vertex(vertex(corner)))
            .collect();
        builder.polygon(&numbers, facet.normal.as_vec3().to_array(), number as u32);
    }
    Ok(builder.finish()?)
}

/// A shipped scene, on a picture of this size.
///
/// # Errors
/// If there is no such scene.
pub(super) fn shipped(name: &str, [width, height]: [u32; 2]) -> Result<Scene, FigureError> {
    let mut scene = resolve(&load(name)?)?.scene;
    (scene.width, scene.height) = (width, height);
    Ok(scene)
}

/// How many pixels of two pictures of one size differ by more than half a grey level.
pub(super) fn differing(a: &LinearPicture, b: &LinearPicture) -> usize {
    let differ = |(a, b): &(&[f32; 4], &[f32; 4])| {
        a.iter().zip(*b).any(|(a, b)| (a - b).abs() > 0.5 / 255.0)
    };
    a.texels().iter().zip(b.texels()).filter(differ).count()
}

/// `picture` in eight bits, with no transfer function.
pub(super) fn stored(picture: &LinearPicture) -> Picture8 {
    store(picture, Encoding::Linear)
}

/// The unit normal that leans so many degrees to the right and so many upward.
pub(super) fn leaning(right: f64, up: f64) -> DVec3 {
    DVec3::new(
        libm::tan(right.to_radians()),
        libm::tan(up.to_radians()),
        1.0,
    )
    .normalize()
}

/// A number as it stands in a sentence: three significant digits, a power of ten if it is very small.
pub(crate) fn written(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && size < 1e-3 {
        let exponent = libm::floor(libm::log10(size)) as i32;
        let digits: String = exponent
            .unsigned_abs()
            .to_string()
            .chars()
            .map(superscript)
            .collect();
        return format!(
            "{:.1}·10⁻{digits}",
            value / libm::pow(10.0, f64::from(exponent))
        );
    }
    let decimals = (0..5)
        .find(|&digits| size >= 100.0 / libm::pow(10.0, f64::from(digits)))
        .unwrap_or(5);
    let text = format!("{value:.*}", decimals as usize);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').into()
    } else {
        text
    }
}

fn superscript(digit: char) -> char {
    ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit.to_digit(10).unwrap_or(0) as usize]
}

#[cfg(test)]
mod tests {
    use super::written;

    #[test]
    fn numbers_in_sentences_are_short() {
        let texts = [
            1234.4, 100.0, 12.345, 1.0, 0.1234, 0.5, 0.00012, -0.0000031, 0.0,
        ]
        .map(written);
        assert_eq!(
            texts,
            [
                "1234",
                "100",
                "12.3",
                "1",
                "0.123",
                "0.5",
                "1.2·10⁻⁴",
                "-3.1·10⁻⁶",
                "0"
            ]
        );
    }
}
