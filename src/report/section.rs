//! One scene of a report: what was measured, and its pictures as files.

use super::encode::{opaque, overlay, shrunk};
use crate::compare::comparison::{
    Comparison, ComparisonData, DifferenceData, Row, RowData, Triangulation,
};
use crate::compare::metrics::difference_map_of_blocks;
use crate::picture::encoding::store;
use crate::picture::image_file::EncodeError;
use crate::picture::{LinearPicture, Picture8};
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use serde::Serialize;

/// Grey levels at the yellow end of every difference map of a report: one scale for all, so that maps can be compared.
pub const MAP_SCALE: f32 = 16.0;

/// Texels of a picture for each texel of its small copy, along each side.
const SHRINKING: usize = 2;

/// How much of its pictures a section keeps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detail {
    /// Difference maps in squares of 4 × 4 pixels, each with its largest difference; of pictures that are nowhere more than
    /// a grey level apart the first only: a page of half the size.
    #[default]
    Blocks,
    /// Difference maps of every pixel, and every picture.
    Full,
}

impl Detail {
    /// The side of a difference map's squares.
    fn block(self) -> usize {
        match self {
            Detail::Blocks => 4,
            Detail::Full => 1,
        }
    }
}

/// What people call a scene.
#[derive(Clone, Debug, Default)]
pub struct Caption {
    /// A few words.
    pub title: String,
    /// What the scene tests; may be empty.
    pub description: String,
}

/// One scene of a report.
#[derive(Clone, Debug)]
pub struct Section {
    /// What people call it.
    pub caption: Caption,
    /// What was measured.
    pub data: ComparisonData,
    /// What cutting its polygons into triangles does; `None` if they are triangles.
    pub triangulation: Option<TriangulationData>,
    /// The reference first, then a figure for each of `data.rows`, then the triangles.
    pub(super) figures: Vec<Figure>,
}

/// A [`Triangulation`] without its picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TriangulationData {
    /// See [`Triangulation::triangles`].
    pub triangles: usize,
    /// See [`Triangulation::not_simple`].
    pub not_simple: usize,
    /// See [`Triangulation::difference`].
    pub difference: DifferenceData,
}

/// A picture with its difference from the reference.
#[derive(Clone, Debug)]
pub(super) struct Figure {
    /// What it shows.
    pub kind: FigureKind,
    /// The PNG file.
    pub picture: Vec<u8>,
    /// True if the file holds only what differs from the reference, to be laid over that.
    pub is_overlay: bool,
    /// The PNG file of the difference map; the reference has none.
    pub map: Option<Vec<u8>>,
    /// The PNG file of the picture at half its size.
    pub small: Vec<u8>,
    /// The rows whose pictures are left out, as they are nowhere more than a grey level from this one.
    pub also: Vec<usize>,
}

/// What a figure shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FigureKind {
    /// The `f64` Phong reference.
    Reference,
    /// The row of that number.
    Row(usize),
    /// The `f64` Phong reference of the polygons cut into triangles.
    Triangles,
}

impl Section {
    /// The section of a comparison. The pictures in it are encoded, and may be dropped then.
    ///
    /// # Errors
    /// [`EncodeError`] if the pictures have no pixels, or more than PNG can count.
    pub fn new(
        caption: Caption,
        comparison: &Comparison,
        triangulation: Option<&Triangulation>,
        detail: Detail,
    ) -> Result<Section, EncodeError> {
        let reference = store(&comparison.reference, comparison.encoding);
        let base = Base {
            linear: &comparison.reference,
            stored: &reference,
            block: detail.block(),
        };
        let mut jobs: Vec<Job<'_>> = Vec::from([Job {
            kind: FigureKind::Reference,
            shot: None,
        }]);
        // Rows with a picture of their own, and those without one beside the row that shows theirs.
        let (mut shown, mut shown_by_others): (Vec<usize>, Vec<(usize, usize)>) =
            Default::default();
        for (
            number,
            Row {
                linear, picture, ..
            },
        ) in comparison.rows.iter().enumerate()
        {
            let is_like =
                |other: &Picture8| detail == Detail::Blocks && within_a_level(other, picture);
            // What hardly differs from the reference is stored as that little.
            let twin = shown
                .iter()
                .find(|row| !is_like(&reference) && is_like(&comparison.rows[**row].picture));
            match twin {
                Some(twin) => shown_by_others.push((*twin, number)),
                None => {
                    shown.push(number);
                    jobs.push(Job {
                        kind: FigureKind::Row(number),
                        shot: Some((linear, picture)),
                    });
                }
            }
        }
        let triangles = triangulation.map(|t| (t, store(&t.picture, comparison.encoding)));
        if let Some((triangulation, stored)) = &triangles {
            jobs.push(Job {
                kind: FigureKind::Triangles,
                shot: Some((&triangulation.picture, stored)),
            });
        }
        let mut figures = encoded(&base, &jobs)?;
        for (twin, number) in shown_by_others {
            let shows_it = |figure: &&mut Figure| figure.kind == FigureKind::Row(twin);
            if let Some(figure) = figures.iter_mut().find(shows_it) {
                figure.also.push(number);
            }
        }
        Ok(Section {
            caption,
            data: ComparisonData::from(comparison),
            triangulation: triangulation.map(TriangulationData::from),
            figures,
        })
    }

    /// All rows: those drawn by scanlines, then those of the barycentric renderer.
    pub(super) fn all_rows(&self) -> impl Iterator<Item = &RowData> {
        self.data.rows.iter().chain(&self.data.barycentric)
    }

    /// The row of a method with its default parameters drawn by scanlines.
    pub(super) fn row(&self, method: &str) -> Option<&RowData> {
        self.data.rows.iter().find(|row| row.variant == method)
    }
}

impl From<&Triangulation> for TriangulationData {
    fn from(t: &Triangulation) -> Self {
        TriangulationData {
            triangles: t.triangles,
            not_simple: t.not_simple,
            difference: t.difference.into(),
        }
    }
}

/// The name of a row that tells it from all others.
pub(super) fn row_name(row: &RowData) -> String {
    if row.is_barycentric() {
        alloc::format!("{}, {}", row.variant, row.engine)
    } else {
        row.variant.to_string()
    }
}

/// True if no channel of two pictures of one size is more than a grey level apart.
fn within_a_level(a: &Picture8, b: &Picture8) -> bool {
    let is_near = |(a, b): (&[u8; 4], &[u8; 4])| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= 1);
    a.texels().iter().zip(b.texels()).all(is_near)
}

/// What pictures are compared with.
struct Base<'a> {
    linear: &'a LinearPicture,
    stored: &'a Picture8,
    /// The side of the squares of difference maps.
    block: usize,
}

/// A figure to be made.
struct Job<'a> {
    kind: FigureKind,
    /// What is shown, before rounding and as stored; `None` for the reference itself.
    shot: Option<(&'a LinearPicture, &'a Picture8)>,
}

impl Job<'_> {
    fn run(&self, base: &Base<'_>) -> Result<Figure, EncodeError> {
        let kind = self.kind;
        let small = |picture| opaque(&shrunk(picture, SHRINKING));
        let Some((linear, stored)) = self.shot else {
            let (picture, small) = (opaque(base.stored)?, small(base.stored)?);
            return Ok(Figure {
                kind,
                picture,
                is_overlay: false,
                map: None,
                small,
                also: Vec::new(),
            });
        };
        let map = difference_map_of_blocks(base.linear, linear, MAP_SCALE, base.block);
        let map = map.expect("pictures of one frame have one size");
        let (whole, over) = (opaque(stored)?, overlay(base.stored, stored)?);
        // To lay one over the other is worth a good part of the file only.
        let is_overlay = over.len() < whole.len() / 4 * 3;
        let picture = if is_overlay { over } else { whole };
        Ok(Figure {
            kind,
            picture,
            is_overlay,
            map: Some(opaque(&map)?),
            small: small(stored)?,
            also: Vec::new(),
        })
    }
}

/// The figures of `jobs`, in their order, made by all processors.
fn encoded(base: &Base<'_>, jobs: &[Job<'_>]) -> Result<Vec<Figure>, EncodeError> {
    let threads = std::thread::available_parallelism()
        .map_or(1, usize::from)
        .min(jobs.len());
    let share = |thread: usize| {
        jobs.iter()
            .skip(thread)
            .step_by(threads)
            .map(|job| job.run(base))
            .collect::<Vec<_>>()
    };
    let mut shares = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads)
            .map(|thread| scope.spawn(move || share(thread)))
            .collect();
        let joined = workers
            .into_iter()
            .map(|worker| worker.join().expect("encoding does not panic").into_iter());
        joined.collect::<Vec<_>>()
    });
    (0..jobs.len())
        .filter_map(|job| shares[job % threads].next())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::comparison::{Input, Options, compare};
    use crate::mesh::builtin::builtin;
    use crate::scene::Scene;
    use crate::shading::Variant;

    /// Vectors and scalars make one picture of slerp: the default page shows it once and knows whose it is.
    #[test]
    fn pictures_that_look_like_others_are_left_out_and_named() {
        let mut scene = Scene::of_mesh(builtin("sphere?rings=3&segments=5").unwrap());
        (scene.width, scene.height) = (40, 30);
        let frame = scene.frame().unwrap();
        let variants =
            ["slerp-phong", "slerp-phong-vector"].map(|name| Variant::parse(name).unwrap());
        let input = Input {
            name: "sphere".into(),
            frame: &frame,
        };
        let comparison = compare(
            &input,
            &variants,
            &Options {
                timing: None,
                ..Options::default()
            },
            &mut |_, _| {},
        );
        let rows = |detail| {
            let section = Section::new(Caption::default(), &comparison, None, detail).unwrap();
            (
                section.figures.len(),
                section.figures.last().map(|figure| figure.also.clone()),
            )
        };
        // The reference, naive Phong, which is always among them, and one or two of slerp.
        assert_eq!(rows(Detail::Blocks), (3, Some([2].into())));
        assert_eq!(rows(Detail::Full), (4, Some([].into())));
    }
}
