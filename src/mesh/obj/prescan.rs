//! The pass over an OBJ file before its parser: every check that needs a line number, and text the parser can take.
//!
//! The parser (`tobj`) gives no line numbers and goes wrong on legal files: it refuses comments after a face and continued
//! lines, reads `l 1 2 3` as a triangle, divides by the weight of `v x y z w`, panics on a relative normal index
//! that is out of range, and starts again with other vertices at each `g`. So it is given positions, normals and faces only,
//! with absolute indices, as one group; groups, materials and smoothing are followed here.

use super::corner::{Corner, WrittenCorner, push_decimal, resolve};
use super::error::{ObjProblem, quote};
use super::lines::{Statements, is_plain_number, keyword, without_comment};
use std::collections::HashMap;
use std::string::String;
use std::vec::Vec;
use std::{format, vec};

/// How large a mesh may become; the true limits except in tests.
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

    /// The warning, if there was anything: `(4 times, first in line 12)` follows `what`.
    fn warn(&self, what: &str, warnings: &mut Vec<String>) {
        match self.count {
            0 => {}
            1 => warnings.push(format!("{what} (line {})", self.line)),
            n => warnings.push(format!("{what} ({n} times, first in line {})", self.line)),
        }
    }
}

/// What the pass found.
#[derive(Default)]
pub(super) struct Prescan {
    /// The text for the parser.
    pub text: Vec<u8>,
    /// How many polygons it holds.
    pub polygons: usize,
    /// How many corners they have together.
    pub corners: usize,
    /// The names of `usemtl`, each once.
    pub material_names: Vec<String>,
    /// Which of the names holds from which polygon on; `None` for none.
    pub material_runs: Vec<(usize, Option<usize>)>,
    /// What follows each `mtllib`, with its line.
    pub libraries: Vec<(usize, String)>,
    material_numbers: HashMap<String, usize>,
    corners_with_normal: usize,
    faces_without_normal: Tally,
    positions: usize,
    normals: usize,
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
    colours: Colours,
    lost_texture_indices: Tally,
    /// Corners with a normal before the file has any, and the first of them that counts backwards.
    early_normals: Tally,
    early_backwards: Option<(usize, i64)>,
}

/// Which positions have a colour.
#[derive(Default)]
struct Colours {
    /// True if the first one has: then the parser is given a colour with each, white where there is none.
    written: bool,
    /// Positions with a colour.
    count: usize,
    /// Positions without one.
    missing: Tally,
    /// Colours over 1 or below 0.
    out_of_range: Tally,
}

/// Which smoothing groups the faces are in.
#[derive(Default)]
struct Smoothing {
    /// The group that holds now: `None` before any `s`, 0 for `s off`.
    current: Option<u64>,
    /// The group of the first face.
    first: Option<Option<u64>>,
    /// Faces of another group than the first, or of none by `s off`.
    edges: Tally,
}

/// Where and what: an error without its path.
type Failure = (Option<usize>, ObjProblem);

/// Reads all of `text`.
///
/// # Errors
/// The first line that is wrong, and how.
pub(super) fn prescan(text: &str, limits: Limits) -> Result<Prescan, Failure> {
    let mut scan = Prescan {
        text: Vec::with_capacity(text.len()),
        ..Prescan::default()
    };
    let mut corners = Vec::new();
    for (line, statement) in Statements::new(text) {
        scan.statement(line, &statement, &mut corners, limits)
            .map_err(|problem| (Some(line), problem))?;
    }
    scan.check_ahead()?;
    if scan.polygons == 0 {
        return Err((
            None,
            ObjProblem::NoPolygons {
                points_or_lines: scan.points_or_lines.count > 0,
            },
        ));
    }
    Ok(scan)
}

impl Prescan {
    /// True if every corner has a normal: only then the normals of the file are used.
    pub(super) fn has_normals(&self) -> bool {
        self.normals > 0 && self.corners_with_normal > 0 && self.faces_without_normal.count == 0
    }

    /// True if every position has a colour: only then the colours of the file are used.
    pub(super) fn has_colours(&self) -> bool {
        self.colours.count > 0 && self.colours.missing.count == 0
    }

    /// What was passed over or read in another way than it may be meant.
    pub(super) fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        let w = &mut warnings;
        self.points_or_lines
            .warn("points and lines are not drawn", w);
        self.free_form.warn(
            "free-form curves and surfaces are not read, only polygons",
            w,
        );
        self.unknown.warn(
            &format!(
                "`{}` is no OBJ statement and is passed over",
                self.unknown_word
            ),
            w,
        );
        self.small_faces.warn(
            "a face of fewer than three different corners is left out",
            w,
        );
        self.repeated_corners
            .warn("a corner that repeats the one before it is left out", w);
        self.weights
            .warn("the weight w of a position is ignored", w);
        if self.colours.count > 0 {
            self.colours.missing.warn(
                "a position has no colour: the colours of the others are not used",
                w,
            );
        }
        if self.has_colours() {
            self.colours
                .out_of_range
                .warn("the colour of a position is not within 0 to 1: what is shown is clamped at each pixel", w);
        }
        let no_coordinates = self.texture_coordinates == 0 && self.lost_texture_indices.count > 0;
        if self.normals == 0 && self.early_normals.count > 0 {
            let what = match no_coordinates {
                true => "normals and texture coordinates",
                false => "normals",
            };
            let what =
                format!("a face names {what}, of which the file has none: normals are averaged");
            self.early_normals.warn(&what, w);
        }
        if self.normals > 0 || self.early_normals.count == 0 || !no_coordinates {
            let what = "a texture coordinate that does not exist is ignored, as all of them are";
            self.lost_texture_indices.warn(what, w);
        }
        if self.normals > 0 && self.corners_with_normal > 0 {
            let what =
                "a face has corners without a normal: averaged normals are used for the whole mesh";
            self.faces_without_normal.warn(what, w);
        }
        if !self.has_normals() {
            let what = "smoothing groups are ignored, normals are averaged over all polygons: a crease angle keeps edges sharp";
            self.smoothing.edges.warn(what, w);
        }
        warnings
    }

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
            _ if word.is_empty() || word.starts_with('#') || GROUPING.contains(&word) => {}
            _ if FREE_FORM.contains(&word) => self.free_form.add(line),
            _ => {
                if self.unknown.count == 0 {
                    self.unknown_word = quote(word);
                }
                self.unknown.add(line);
            }
        }
        Ok(())
    }

    /// A position or a normal: three finite numbers; a position may have a colour, three more. What else follows (a weight)
    /// is checked and dropped.
    fn vector(&mut self, keyword: &'static str, line: usize, rest: &str) -> Result<(), ObjProblem> {
        let bad = |word: &str| ObjProblem::BadNumber {
            keyword,
            found: quote(word),
        };
        let mut found = 0;
        let mut more = [0.0; 3];
        self.text.extend_from_slice(keyword.as_bytes());
        for word in without_comment(rest).split_ascii_whitespace() {
            found += 1;
            if found <= 3 {
                self.text.push(b' ');
                self.text.extend_from_slice(word.as_bytes());
                // The parser finds its value; most are plainly numbers, and need not be read twice.
                if is_plain_number(word) {
                    continue;
                }
            }
            let number: f32 = word.parse().map_err(|_| bad(word))?;
            if !number.is_finite() {
                return Err(bad(word));
            }
            if (4..=6).contains(&found) {
                more[found - 4] = number;
            }
        }
        if found < 3 {
            return Err(ObjProblem::TooFewNumbers { keyword, found });
        }
        if keyword == "vn" {
            self.text.push(b'\n');
            self.normals += 1;
            return Ok(());
        }
        self.colour(line, (found == 6).then_some(more));
        self.text.push(b'\n');
        self.positions += 1;
        if found == 4 && more[0] != 1.0 {
            self.weights.add(line);
        }
        Ok(())
    }

    /// The colour of the position that was just read, if it has one.
    fn colour(&mut self, line: usize, colour: Option<[f32; 3]>) {
        let colours = &mut self.colours;
        colours.written |= self.positions == 0 && colour.is_some();
        match colour {
            Some(colour) => {
                colours.count += 1;
                if !colour.iter().all(|c| (0.0..=1.0).contains(c)) {
                    colours.out_of_range.add(line);
                }
            }
            None => colours.missing.add(line),
        }
        if colours.written {
            let [r, g, b] = colour.unwrap_or([1.0; 3]);
            self.text
                .extend_from_slice(format!(" {r} {g} {b}").as_bytes());
        }
    }

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
        if self.polygons == limits.polygons {
            return Err(ObjProblem::TooManyPolygons);
        }
        if corners.len() > limits.corners - self.corners {
            return Err(ObjProblem::TooManyCorners);
        }
        self.polygons += 1;
        self.corners += corners.len();
        self.smoothing.face(line);
        self.write_face(line, corners);
        Ok(())
    }

    fn write_face(&mut self, line: usize, corners: &[Corner]) {
        self.text.push(b'f');
        for &(position, normal) in corners {
            self.text.push(b' ');
            push_decimal(&mut self.text, position + 1);
            if let Some(normal) = normal {
                self.text.extend_from_slice(b"//");
                push_decimal(&mut self.text, normal + 1);
                self.corners_with_normal += 1;
            }
        }
        self.text.push(b'\n');
        if corners.iter().any(|(_, normal)| normal.is_none()) {
            self.faces_without_normal.add(line);
        }
    }

    fn corner(&mut self, line: usize, word: &str) -> Result<Corner, ObjProblem> {
        let written = WrittenCorner::read(word)?;
        if let Some(index) = written.texture
            && (index == 0 || index.unsigned_abs() > self.texture_coordinates as u64)
        {
            self.lost_texture_indices.add(line);
        }
        let position = resolve(
            "position",
            written.position,
            self.positions,
            line,
            &mut self.ahead[0],
        )?;
        if self.normals == 0 && written.normal.is_some_and(|index| index != 0) {
            self.early_normals.add(line);
        }
        let normal = match written.normal {
            Some(index) if index < 0 && self.normals == 0 => {
                self.early_backwards.get_or_insert((line, index));
                None
            }
            Some(index) => Some(resolve(
                "normal",
                index,
                self.normals,
                line,
                &mut self.ahead[1],
            )?),
            None => None,
        };
        Ok((position, normal))
    }

    /// The indices that were past the end when they were met: a later line may have brought what they name. A file that has no
    /// normals at all may name them.
    fn check_ahead(&self) -> Result<(), Failure> {
        let error =
            |line, what, index, count| (line, ObjProblem::IndexOutOfRange { what, index, count });
        let missing = |which: usize, what: &'static str, count: usize| {
            let mut ahead = self.ahead[which].iter();
            let &(line, index) = ahead.find(|&&(_, index)| index >= count)?;
            Some(error(line, what, index as i64 + 1, count))
        };
        let mut missing_all = vec![missing(0, "position", self.positions)];
        if self.normals > 0 {
            missing_all.push(missing(1, "normal", self.normals));
            let backwards = self.early_backwards;
            missing_all.push(backwards.map(|(line, index)| error(line, "normal", index, 0)));
        }
        match missing_all
            .into_iter()
            .flatten()
            .min_by_key(|&(line, _)| line)
        {
            Some((line, problem)) => Err((Some(line), problem)),
            None => Ok(()),
        }
    }

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
        self.material_runs.push((self.polygons, current));
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

/// The number of a smoothing group: 0 for `off`, and for what is no number.
fn smoothing_group(word: &str) -> u64 {
    word.parse().unwrap_or(if word == "on" { 1 } else { 0 })
}

/// Statements that change nothing in a picture of polygons: names, groups, textures, levels of detail, display.
const GROUPING: [&str; 14] = [
    "o",
    "g",
    "mg",
    "usemap",
    "maplib",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "call",
];

/// Statements of free-form curves and surfaces.
const FREE_FORM: [&str; 22] = [
    "vp", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole", "scrv",
    "sp", "end", "con", "bsp", "bzp", "cdc", "cdp", "res", "csh", "fm",
];
