//! The pass over an OBJ file: positions, normals, faces and materials as they are written, checked line by line.

use super::corner::{Corner, WrittenCorner, resolve};
use super::error::{ObjProblem, quote};
use super::lines::{Statements, keyword, without_comment};
use glam::Vec3;
use std::collections::HashMap;
use std::format;
use std::string::String;
use std::vec::Vec;

/// The largest size of a mesh; the true limits except in tests.
#[derive(Clone, Copy)]
pub(super) struct Limits {
    pub polygons: usize,
    pub corners: usize,
}

/// Something that is passed over with one warning: how often, and where first.
#[derive(Default)]
pub(super) struct Tally {
    pub count: usize,
    pub line: usize,
}

impl Tally {
    fn add(&mut self, line: usize) {
        if self.count == 0 {
            self.line = line;
        }
        self.count += 1;
    }
}

/// The contents of an OBJ file.
#[derive(Default)]
pub(super) struct Scan {
    /// Positions, with or without a face that uses them.
    pub positions: Vec<Vec3>,
    /// A colour for each position, if all have one.
    pub colours: Vec<Vec3>,
    /// Normals as they are written, of any length.
    pub normals: Vec<Vec3>,
    /// The corners of all polygons.
    pub corners: Vec<Corner>,
    /// The number of corners of each polygon.
    pub sides: Vec<usize>,
    /// The names of `usemtl`, each once.
    pub material_names: Vec<String>,
    /// The first polygon of each run and the number of its name; `None` for none.
    pub material_runs: Vec<(usize, Option<usize>)>,
    /// The text after each `mtllib`, with its line.
    pub libraries: Vec<(usize, String)>,
    material_numbers: HashMap<String, usize>,
    corners_with_normal: usize,
    faces_without_normal: Tally,
    texture_coordinates: usize,
    /// Indices past the positions (first) or normals (second) so far, each larger than those before it.
    ahead: [Vec<(usize, usize)>; 2],
    smoothing: Smoothing,
    points_or_lines: Tally,
    free_form: Tally,
    unknown: Tally,
    unknown_word: String,
    small_faces: Tally,
    repeated_corners: Tally,
    weights: Tally,
    uncoloured: Tally,
    strange_colours: Tally,
    lost_texture_indices: Tally,
}

/// The smoothing groups of the faces.
#[derive(Default)]
struct Smoothing {
    /// The group that holds now: `None` before any `s`, 0 for `s off`.
    current: Option<u64>,
    /// The group of the first face.
    first: Option<Option<u64>>,
    /// Faces of another group than the first, or of none by `s off`.
    edges: Tally,
}

/// An error without its path: line and problem.
type Failure = (Option<usize>, ObjProblem);

/// Reads all of `text`.
///
/// # Errors
/// The first line that is wrong, and how.
pub(super) fn scan(text: &str, limits: Limits) -> Result<Scan, Failure> {
    let mut scan = Scan::default();
    let mut corners = Vec::new();
    for (line, statement) in Statements::new(text) {
        scan.statement(line, &statement, &mut corners, limits)
            .map_err(|problem| (Some(line), problem))?;
    }
    scan.check_ahead()?;
    if scan.sides.is_empty() {
        let points_or_lines = scan.points_or_lines.count > 0;
        return Err((None, ObjProblem::NoPolygons { points_or_lines }));
    }
    Ok(scan)
}

impl Scan {
    /// True if every corner has a normal: only then the normals of the file are used.
    pub(super) fn has_normals(&self) -> bool {
        self.corners_with_normal > 0 && self.faces_without_normal.count == 0
    }

    /// True if every position has a colour: only then the colours of the file are used.
    pub(super) fn has_colours(&self) -> bool {
        !self.colours.is_empty() && self.uncoloured.count == 0
    }

    /// Says what was passed over or read in another way than it may be meant.
    pub(super) fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        let mut warn = |tally: &Tally, what: &str| match (tally.count, tally.line) {
            (0, _) => {}
            (1, line) => warnings.push(format!("{what} (line {line})")),
            (n, line) => warnings.push(format!("{what} ({n} times, first in line {line})")),
        };
        warn(&self.points_or_lines, "points and lines are not drawn");
        let what = "free-form curves and surfaces are not read, only polygons";
        warn(&self.free_form, what);
        let what = "is no OBJ statement and is passed over";
        warn(&self.unknown, &format!("`{}` {what}", self.unknown_word));
        let what = "a face of fewer than three different corners is left out";
        warn(&self.small_faces, what);
        let what = "a corner that repeats the one before it is left out";
        warn(&self.repeated_corners, what);
        warn(&self.weights, "the weight w of a position is ignored");
        if !self.colours.is_empty() {
            let what = "a position has no colour: the colours of the others are not used";
            warn(&self.uncoloured, what);
        }
        if self.has_colours() {
            let what = "the colour of a position is not within 0 to 1: what is shown is clamped at each pixel";
            warn(&self.strange_colours, what);
        }
        let what = "a texture coordinate that does not exist is ignored, as all of them are";
        warn(&self.lost_texture_indices, what);
        if self.corners_with_normal > 0 {
            let what =
                "a face has corners without a normal: averaged normals are used for the whole mesh";
            warn(&self.faces_without_normal, what);
        }
        if !self.has_normals() {
            let what = "smoothing groups are ignored, normals are averaged over all polygons: a crease angle keeps edges sharp";
            warn(&self.smoothing.edges, what);
        }
        warnings
    }

    /// Reads one statement.
    fn statement(
        &mut self,
        line: usize,
        statement: &str,
        corners: &mut Vec<Corner>,
        limits: Limits,
    ) -> Result<(), ObjProblem> {
        let (word, rest) = keyword(statement);
        match word {
            "v" => self.vector("v", line, rest)?,
            "vn" => self.vector("vn", line, rest)?,
            "vt" => self.texture_coordinates += 1,
            // `fo` is what version 2 of the format called a face.
            "f" | "fo" => self.face(line, rest, corners, limits)?,
            "usemtl" => self.use_material(rest),
            "mtllib" => self.libraries.push((line, rest.into())),
            "s" => self.smoothing.current = Some(smoothing_group(without_comment(rest).trim())),
            "p" | "l" => self.points_or_lines.add(line),
            _ if word.is_empty() || word.starts_with('#') || is_among(word, GROUPING) => {}
            _ if is_among(word, FREE_FORM) => self.free_form.add(line),
            _ => {
                if self.unknown.count == 0 {
                    self.unknown_word = quote(word);
                }
                self.unknown.add(line);
            }
        }
        Ok(())
    }

    /// Reads a position or a normal: three finite numbers; a position may have a colour, three more. Others (a weight)
    /// are checked and dropped.
    fn vector(&mut self, keyword: &'static str, line: usize, rest: &str) -> Result<(), ObjProblem> {
        let (mut numbers, mut found) = ([0.0; 6], 0);
        for word in without_comment(rest).split_ascii_whitespace() {
            let number = word.parse().ok().filter(|number: &f32| number.is_finite());
            let number = number.ok_or_else(|| ObjProblem::BadNumber {
                keyword,
                found: quote(word),
            })?;
            if let Some(place) = numbers.get_mut(found) {
                *place = number;
            }
            found += 1;
        }
        let [x, y, z, r, g, b] = numbers;
        let vector = Vec3::new(x, y, z);
        match (keyword, found) {
            (_, ..3) => return Err(ObjProblem::TooFewNumbers { keyword, found }),
            ("vn", _) => self.normals.push(vector),
            _ => {
                self.positions.push(vector);
                if found == 4 && r != 1.0 {
                    self.weights.add(line);
                }
                if found != 6 {
                    self.uncoloured.add(line);
                } else {
                    self.colours.push(Vec3::new(r, g, b));
                    if ![r, g, b].iter().all(|c| (0.0..=1.0).contains(c)) {
                        self.strange_colours.add(line);
                    }
                }
            }
        }
        Ok(())
    }

    /// Reads a face: its corners without repetitions.
    fn face(
        &mut self,
        line: usize,
        rest: &str,
        corners: &mut Vec<Corner>,
        limits: Limits,
    ) -> Result<(), ObjProblem> {
        corners.clear();
        let mut repeats = false;
        for word in without_comment(rest).split_ascii_whitespace() {
            let corner = self.corner(line, word)?;
            if corners
                .last()
                .is_some_and(|last: &Corner| last.0 == corner.0)
            {
                repeats = true;
            } else {
                corners.push(corner);
            }
        }
        while corners.len() > 1 && corners[0].0 == corners[corners.len() - 1].0 {
            corners.pop();
            repeats = true;
        }
        if corners.len() < 3 {
            self.small_faces.add(line);
            return Ok(());
        }
        if repeats {
            self.repeated_corners.add(line);
        }
        if self.sides.len() == limits.polygons {
            return Err(ObjProblem::TooManyPolygons);
        }
        if corners.len() > limits.corners - self.corners.len() {
            return Err(ObjProblem::TooManyCorners);
        }
        self.sides.push(corners.len());
        self.smoothing.face(line);
        let with_normal = corners.iter().filter(|corner| corner.1.is_some()).count();
        self.corners_with_normal += with_normal;
        if with_normal < corners.len() {
            self.faces_without_normal.add(line);
        }
        self.corners.append(corners);
        Ok(())
    }

    /// Reads a corner; notes indices that are ahead of their entries.
    fn corner(&mut self, line: usize, word: &str) -> Result<Corner, ObjProblem> {
        let written = WrittenCorner::read(word)?;
        if let Some(index) = written.texture
            && (index == 0 || index.unsigned_abs() > self.texture_coordinates as u64)
        {
            self.lost_texture_indices.add(line);
        }
        let [far_positions, far_normals] = &mut self.ahead;
        let (positions, normals) = (self.positions.len(), self.normals.len());
        let normal = |index| resolve("normal", index, normals, line, far_normals);
        Ok((
            resolve("position", written.position, positions, line, far_positions)?,
            written.normal.map(normal).transpose()?,
        ))
    }

    /// Checks the indices that were past the end when they were met: a later line may have brought what they name.
    fn check_ahead(&self) -> Result<(), Failure> {
        let missing = |which: usize, what: &'static str, count: usize| {
            let is_missing = |&&(_, index): &&(usize, usize)| index >= count;
            let &(line, index) = self.ahead[which].iter().find(is_missing)?;
            let index = index as i64 + 1;
            Some((line, ObjProblem::IndexOutOfRange { what, index, count }))
        };
        let missing = [
            missing(0, "position", self.positions.len()),
            missing(1, "normal", self.normals.len()),
        ];
        match missing.into_iter().flatten().min_by_key(|&(line, _)| line) {
            Some((line, problem)) => Err((Some(line), problem)),
            None => Ok(()),
        }
    }

    /// Begins a run of polygons of one material.
    fn use_material(&mut self, name: &str) {
        let next = self.material_numbers.len();
        let current = (!name.is_empty()).then(|| match self.material_numbers.get(name) {
            Some(&known) => known,
            None => {
                self.material_numbers.insert(name.into(), next);
                self.material_names.push(name.into());
                next
            }
        });
        self.material_runs.push((self.sides.len(), current));
    }
}

impl Smoothing {
    fn face(&mut self, line: usize) {
        let first = *self.first.get_or_insert(self.current);
        if self.current != first || self.current == Some(0) {
            self.edges.add(line);
        }
    }
}

/// Returns the number of a smoothing group: 0 for `off`, and for what is no number.
fn smoothing_group(word: &str) -> u64 {
    word.parse().unwrap_or(if word == "on" { 1 } else { 0 })
}

/// Statements that change nothing in a picture of polygons: names, groups, textures, levels of detail, display.
const GROUPING: &str =
    "o g mg usemap maplib bevel c_interp d_interp lod shadow_obj trace_obj ctech stech call";

/// Statements of free-form curves and surfaces.
const FREE_FORM: &str = "vp cstype deg bmat step curv curv2 surf parm trim hole scrv sp end con bsp bzp cdc cdp res csh fm";

fn is_among(word: &str, words: &str) -> bool {
    words.split(' ').any(|other| other == word)
}
