//! The method table, and a method as a user names it.

use super::bands;
use super::count::{self, OperationCounts};
use super::dispatch::{Job, dispatch};
use super::span::{self, SpanBench};
use super::{
    DuffPhong, FastPhong, FastPhongRsqrt, Flat, FlatAverage, Gouraud, GouraudSeparate, Info,
    Method, NaivePhong, Parameter, PhongRsqrt, Shader, SlerpPhong, SlerpPhongVector,
};
use crate::encoding::store;
use crate::frame::Frame;
use crate::number::{Level, Scalar};
use crate::picture::Picture;
use crate::picture::{LinearPicture, Picture8};
use crate::raster::{
    Bands, Edges, PictureBands, Plan, Renderer, Target, Texel, barycentric, clear, draw_anyhow,
    draw_rows, linear_picture, picture8, scanline,
};
use crate::scene::Encoding;
use crate::suggest::nearest;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt;

/// All shading methods. A method is one file beside this one, and one line here.
pub static METHODS: &[Entry] = &[
    Entry::of::<Flat>(),
    Entry::of::<FlatAverage>(),
    Entry::of::<Gouraud>(),
    Entry::of::<GouraudSeparate>(),
    Entry::of::<NaivePhong>(),
    Entry::of::<FastPhong>(),
    Entry::of::<FastPhongRsqrt>(),
    Entry::of::<PhongRsqrt>(),
    Entry::of::<DuffPhong>(),
    Entry::of::<SlerpPhong>(),
    Entry::of::<SlerpPhongVector>(),
];

type DrawBarycentric = fn(&Frame, &[u32], Edges, &mut dyn Target);

/// A row of the method table: what is said about a method, and what can be done with it.
#[derive(Clone, Copy)]
pub struct Entry {
    /// What is said about it.
    pub info: &'static Info,
    draw: fn(&Frame, &[u32], &mut dyn Target),
    refusal: fn(&Frame) -> Option<&'static str>,
    pub(super) draw_bands: fn(&Frame, &[u32], Level, &mut dyn Bands) -> bool,
    draw_barycentric: Option<DrawBarycentric>,
    count: fn(&[u32], &SpanBench) -> OperationCounts,
    span: fn(&[u32], &SpanBench, &mut [[f32; 3]]),
    span_on: fn(&[u32], &SpanBench, Level, [&mut [f32]; 3]),
}

impl fmt::Debug for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Entry").field(&self.info.name).finish()
    }
}

impl Entry {
    /// The row of a method, also of one defined outside this crate.
    pub const fn of<D: Method>() -> Entry {
        Entry {
            info: &D::INFO,
            draw: draw::<D>,
            refusal: bands::refusal::<D>,
            draw_bands: bands::draw::<D>,
            draw_barycentric: if D::INFO.barycentric {
                Some(draw_barycentric::<D>)
            } else {
                None
            },
            count: count::count::<D>,
            span: span::shade::<D>,
            span_on: span::shade_on::<D>,
        }
    }

    /// The row called `name`.
    pub fn named(name: &str) -> Option<&'static Entry> {
        METHODS.iter().find(|entry| entry.info.name == name)
    }

    /// The method with its default parameters.
    pub fn variant(&'static self) -> Variant {
        Variant {
            entry: self,
            parameters: self.info.parameters.iter().map(|p| p.default).collect(),
        }
    }
}

fn draw<D: Method>(frame: &Frame, parameters: &[u32], target: &mut dyn Target) {
    struct Draw<'a>(&'a Frame, &'a [u32], &'a mut dyn Target);
    impl Job for Draw<'_> {
        type Out = ();
        fn run<S: Shader>(self) {
            scanline::draw::<S, Scalar>(Scalar, self.0, self.1, self.2);
        }
    }
    dispatch::<D, _>(frame, Draw(frame, parameters, target));
}

fn draw_barycentric<D: Method>(
    frame: &Frame,
    parameters: &[u32],
    edges: Edges,
    target: &mut dyn Target,
) {
    struct Draw<'a>(&'a Frame, &'a [u32], Edges, &'a mut dyn Target);
    impl Job for Draw<'_> {
        type Out = ();
        fn run<S: Shader>(self) {
            barycentric::draw::<S, Scalar>(Scalar, self.0, self.1, self.2, self.3);
        }
    }
    dispatch::<D, _>(frame, Draw(frame, parameters, edges, target));
}

/// A method with values for its parameters: what the lecture calls a variant, as in `fast-phong:steps=1`.
#[derive(Clone, Debug)]
pub struct Variant {
    entry: &'static Entry,
    parameters: Vec<u32>,
}

impl Variant {
    /// The variant that `text` names: `NAME` or `NAME:key=value`, further parameters after further colons.
    ///
    /// # Errors
    /// [`MethodError`] when there is no such method or parameter, or the value is outside its range.
    pub fn parse(text: &str) -> Result<Variant, MethodError> {
        let mut parts = text.split(':');
        let name = parts.next().unwrap_or_default();
        let entry = Entry::named(name).ok_or_else(|| MethodError::UnknownMethod {
            name: name.to_string(),
        })?;
        let mut variant = entry.variant();
        for part in parts {
            let (key, value) = part.split_once('=').unwrap_or((part, ""));
            let place = entry
                .info
                .parameters
                .iter()
                .position(|p| p.name == key)
                .ok_or_else(|| MethodError::UnknownParameter {
                    method: entry.info,
                    key: key.to_string(),
                })?;
            let parameter = &entry.info.parameters[place];
            let number = parameter.parse(value);
            variant.parameters[place] = number.ok_or_else(|| MethodError::Value {
                parameter,
                value: value.to_string(),
            })?;
        }
        Ok(variant)
    }

    /// Its row of the method table.
    pub fn entry(&self) -> &'static Entry {
        self.entry
    }

    /// What is said about its method.
    pub fn info(&self) -> &'static Info {
        self.entry.info
    }

    /// The values of its parameters, in the order of [`Info::parameters`].
    pub fn parameters(&self) -> &[u32] {
        &self.parameters
    }

    /// Whether all parameters have their default values.
    pub fn is_default(&self) -> bool {
        self.parameters
            .iter()
            .zip(self.info().parameters)
            .all(|(value, p)| *value == p.default)
    }

    /// As [`Info::bound`], with these values of the parameters.
    pub fn bound(&self, frame: &Frame) -> f64 {
        self.info().bound_with(frame, &self.parameters)
    }

    /// Draws `frame` as a stored picture.
    ///
    /// ```
    /// use fastphong::mesh::builtin::builtin;
    /// use fastphong::scene::Scene;
    /// use fastphong::shader::{METHODS, Variant};
    ///
    /// let mut scene = Scene::of_mesh(builtin("sphere")?);
    /// (scene.width, scene.height) = (64, 48);
    /// let frame = scene.frame()?;
    /// let picture = Variant::parse("gouraud")?.render(&frame);
    /// assert_eq!(picture.get(32, 24)[3], 255, "the sphere is in the middle");
    /// // Every method covers the same pixels.
    /// for method in METHODS {
    ///     let other = method.variant().render(&frame);
    ///     assert!(picture.texels().iter().zip(other.texels()).all(|(a, b)| a[3] == b[3]));
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn render(&self, frame: &Frame) -> Picture8 {
        match frame.encoding() {
            Encoding::Linear => self.rows(frame, picture8(frame)),
            Encoding::Srgb => store(&self.render_linear(frame), Encoding::Srgb),
        }
    }

    /// Draws `frame` into `picture`, which is made anew unless it has the size of the frame's picture: for drawing many frames without
    /// asking for memory each time.
    pub fn render_into(&self, frame: &Frame, picture: &mut Picture8) {
        if (picture.width(), picture.height()) != (frame.picture_width(), frame.picture_height())
            || frame.encoding() != Encoding::Linear
        {
            *picture = self.render(frame);
            return;
        }
        clear(frame, picture);
        draw_rows(frame, picture, |target| {
            (self.entry.draw)(frame, &self.parameters, target)
        });
    }

    /// Draws `frame` before rounding: linear channels, clamped to 0..=1.
    pub fn render_linear(&self, frame: &Frame) -> LinearPicture {
        self.rows(frame, linear_picture(frame))
    }

    /// Draws `frame` over an empty picture. Pictures are stored line by line as they are drawn.
    fn rows<T: Texel>(&self, frame: &Frame, mut picture: Picture<T>) -> Picture<T> {
        draw_rows(frame, &mut picture, |target| {
            (self.entry.draw)(frame, &self.parameters, target)
        });
        picture
    }

    /// Returns what draws `frame` with this method where `renderer` is asked for: that, or the span engine with the reason.
    ///
    /// The row engine does not draw more than four lights, depth that is computed per sample, frames clipped by the NDC
    /// cube, nor methods that follow light at positions along a span.
    pub fn plan(&self, frame: &Frame, renderer: Renderer) -> Plan {
        let reason = match renderer {
            Renderer::Span => None,
            Renderer::Row(level) if level == Level::Scalar || !level.is_available() => {
                Some("this machine does not have these SIMD instructions")
            }
            Renderer::Row(_) => (self.entry.refusal)(frame),
        };
        Plan {
            renderer: if reason.is_some() {
                Renderer::Span
            } else {
                renderer
            },
            reason,
        }
    }

    /// Draws `frame` with an engine and an instruction set into `picture`, which is made anew unless it has the size of the
    /// frame's picture.
    pub fn render_with(&self, frame: &Frame, renderer: Renderer, picture: &mut Picture8) {
        if frame.encoding() != Encoding::Linear {
            *picture = store(&self.render_linear_with(frame, renderer), frame.encoding());
            return;
        }
        if (picture.width(), picture.height()) != (frame.picture_width(), frame.picture_height()) {
            *picture = picture8(frame);
        }
        self.draw_with(frame, renderer, picture);
    }

    /// Draws `frame` with an engine and an instruction set, before rounding: linear channels, clamped to 0..=1.
    pub fn render_linear_with(&self, frame: &Frame, renderer: Renderer) -> LinearPicture {
        let mut picture = linear_picture(frame);
        self.draw_with(frame, renderer, &mut picture);
        picture
    }

    fn draw_with<T: Texel>(&self, frame: &Frame, renderer: Renderer, picture: &mut Picture<T>) {
        if let Renderer::Row(level) = self.plan(frame, renderer).renderer {
            let mut bands = PictureBands { frame, picture };
            if (self.entry.draw_bands)(frame, &self.parameters, level, &mut bands) {
                return;
            }
        }
        picture.texels_mut().fill(T::background(frame.background()));
        draw_rows(frame, picture, |target| {
            (self.entry.draw)(frame, &self.parameters, target)
        });
    }

    /// Draws the triangles of `frame` with the barycentric renderer; `None` when it does not have this method.
    pub fn render_barycentric(&self, frame: &Frame, edges: Edges) -> Option<Picture8> {
        match frame.encoding() {
            Encoding::Linear => self.triangles(frame, edges, picture8(frame)),
            Encoding::Srgb => Some(store(
                &self.render_barycentric_linear(frame, edges)?,
                Encoding::Srgb,
            )),
        }
    }

    /// As [`Variant::render_barycentric`], before rounding.
    pub fn render_barycentric_linear(&self, frame: &Frame, edges: Edges) -> Option<LinearPicture> {
        self.triangles(frame, edges, linear_picture(frame))
    }

    /// Draws the triangles of `frame` over an empty picture.
    fn triangles<T: Texel>(
        &self,
        frame: &Frame,
        edges: Edges,
        mut picture: Picture<T>,
    ) -> Option<Picture<T>> {
        let draw = self.entry.draw_barycentric?;
        draw_anyhow(frame, &mut picture, |target| {
            draw(frame, &self.parameters, edges, target)
        });
        Some(picture)
    }

    /// How many operations of each kind it takes with one light (`lights` ≤ 1) or four, counted by running it on
    /// numbers that count.
    pub fn operations(&self, lights: usize) -> OperationCounts {
        self.operations_on(&SpanBench::new(20.0, lights))
    }

    /// How many operations of each kind it takes on a span.
    pub fn operations_on(&self, bench: &SpanBench) -> OperationCounts {
        (self.entry.count)(&self.parameters, bench)
    }

    /// Shades one span into `out`: the set-up and as many pixels as `out` has.
    pub fn shade_span(&self, bench: &SpanBench, out: &mut [[f32; 3]]) {
        (self.entry.span)(&self.parameters, bench, out);
    }

    /// The same on an instruction set, into red, green and blue: of each as many whole groups of [`Level::width`] pixels as
    /// the slices have. The kernel of the engines, with nothing around it.
    pub fn shade_span_on(&self, level: Level, bench: &SpanBench, channels: [&mut [f32]; 3]) {
        (self.entry.span_on)(&self.parameters, bench, level, channels);
    }
}

impl fmt::Display for Variant {
    /// The name, and those parameters that differ from their defaults.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.info().name)?;
        for (value, parameter) in self.parameters.iter().zip(self.info().parameters) {
            if *value != parameter.default {
                write!(f, ":{}={}", parameter.name, parameter.text(*value))?;
            }
        }
        Ok(())
    }
}

/// Why a text names no variant.
#[derive(Clone, Debug)]
pub enum MethodError {
    /// There is no such method.
    UnknownMethod {
        /// The name given.
        name: String,
    },
    /// The method has no such parameter.
    UnknownParameter {
        /// What is said about the method.
        method: &'static Info,
        /// The name given.
        key: String,
    },
    /// The value is not a whole number in its range.
    Value {
        /// The parameter.
        parameter: &'static Parameter,
        /// The value given.
        value: String,
    },
}

impl fmt::Display for MethodError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MethodError::UnknownMethod { name } => {
                write!(f, "unknown method `{name}`")?;
                let names = || METHODS.iter().map(|entry| entry.info.name);
                if let Some(near) = nearest(name, names()) {
                    return write!(f, ": did you mean `{near}`?");
                }
                write!(f, ": expected one of ")?;
                list(f, names())
            }
            MethodError::UnknownParameter { method, key } if method.parameters.is_empty() => {
                write!(
                    f,
                    "method `{}` has no parameters, so `{key}` means nothing",
                    method.name
                )
            }
            MethodError::UnknownParameter { method, key } => {
                write!(
                    f,
                    "method `{}` has no parameter `{key}`: expected one of ",
                    method.name
                )?;
                list(f, method.parameters.iter().map(|p| p.name))
            }
            MethodError::Value { parameter, value } => {
                let Parameter {
                    name, least, most, ..
                } = parameter;
                let auto = if parameter.auto.is_some() {
                    "`auto` or "
                } else {
                    ""
                };
                write!(
                    f,
                    "`{name}={value}`: expected {auto}a whole number from {least} to {most}"
                )
            }
        }
    }
}

fn list<'a>(f: &mut fmt::Formatter<'_>, names: impl Iterator<Item = &'a str>) -> fmt::Result {
    for (i, name) in names.enumerate() {
        write!(f, "{}`{name}`", if i == 0 { "" } else { ", " })?;
    }
    Ok(())
}

impl core::error::Error for MethodError {}
