//! The pass over an OBJ file before the parser. It makes every check that needs a line number, and
//! writes text that the parser accepts.
//!
//! The parser (`tobj`) reports no line numbers and fails on legal files. It refuses comments after
//! a face and continued lines, reads `l 1 2 3` as a triangle, divides by the weight of `v x y z w`,
//! panics on a relative normal index that is out of range, and starts again with other vertices at
//! each `g`. So it gets only positions, normals and faces, with absolute indices and in one group.
//! The pre-scan itself follows groups, materials and smoothing.

use super::super::polygons::{
    POINTS_OR_LINES, count_repeated_corner, count_small_face, look_like_bytes, points_or_lines,
};
use super::corner::{Entries, ObjCorner, WrittenCorner};
use super::error::{ObjProblem, VectorProblem, quote};
use super::lines::{
    FREE_FORM, Statements, is_plain_number, keyword, line_number, read_number, without_comment,
};
use crate::note::{Note, Notes};
use core::mem::take;
use glam::Vec3;
use std::borrow::Cow;
use std::format;
use std::str::SplitAsciiWhitespace;
use std::string::String;
use std::vec::Vec;

/// The largest mesh that is accepted: the limits of [`PolygonMesh`](crate::mesh::PolygonMesh),
/// except in tests.
#[derive(Clone, Copy, Default)]
pub(super) struct MeshLimits {
    pub polygons: usize,
    pub corners: usize,
}

// The kinds of notes that decide about others, or about the file.
const UNKNOWN: &str = "statement-unknown";
const BAD_POSITION: &str = "position-not-finite";
const WITHOUT_COLOUR: &str = "colours-missing";
const COLOUR_OUT_OF_RANGE: &str = "colours-over-range";
const NO_NORMAL: &str = "normal-missing";
const UNDECLARED_NORMAL: &str = "normals-undeclared";
const NO_TEXTURE_COORDINATE: &str = "texture-coordinate-missing";

/// The text for the parser, and everything that the parser does not see.
#[derive(Default)]
pub(super) struct Prescan {
    /// The text for the parser.
    pub text: Vec<u8>,
    /// How many polygons the text has.
    pub polygons: usize,
    /// How many corners they have together.
    pub corners: usize,
    /// Each `o`: the first polygon that it applies to, and the name.
    pub object_runs: Vec<(usize, String)>,
    /// Each `s`: the first polygon that it applies to, and the group; 0 for `off`.
    pub smoothing_runs: Vec<(usize, u64)>,
    /// Each `usemtl`: the first polygon that it applies to, and the name, which may be empty.
    pub material_runs: Vec<(usize, String)>,
    /// The line of each `mtllib`, and the rest of the statement.
    pub libraries: Vec<(usize, String)>,
    limits: MeshLimits,
    positions: Entries,
    /// How many normals were read so far.
    normals: usize,
    /// How many normals the whole file has, if a first pass counted them. A corner may name a
    /// normal before its line.
    all_normals: Option<usize>,
    /// One more than the largest index of a normal that a corner names.
    named_normals: usize,
    /// The line of each normal; 0 for a normal that a face names.
    unused_normals: Vec<u32>,
    texture_coordinates: usize,
    /// How many corners have their own normal.
    pub corners_with_normal: usize,
    /// The positions that are not three finite numbers.
    bad_positions: Vec<BadPosition>,
    /// The line of the first face that uses each position; 0 if none does.
    first_uses: Vec<u32>,
    /// The positions in the order in which faces first use them. The parser's mesh has this order.
    pub used_positions: Vec<u32>,
    /// The colour of each position, up to the last position that has one; [`NO_COLOUR`] for the
    /// others.
    colours: Vec<Vec3>,
    /// True if the first word that is not a statement is `newmtl`.
    is_library: bool,
    /// What is ignored, or read in another way than its author may have meant.
    pub notes: Notes,
}

/// A position that is not three finite numbers.
struct BadPosition {
    /// Its index, counted from 0.
    index: usize,
    line: usize,
    problem: VectorProblem,
}

/// Stands for a missing colour.
const NO_COLOUR: Vec3 = Vec3::NAN;

/// The reason why a file is refused.
pub(super) struct Refusal {
    /// The first line that is wrong; `None` for the file as a whole.
    pub line: Option<usize>,
    pub problem: ObjProblem,
    /// Notes from before the problem.
    pub notes: Notes,
}

/// Scans all of `text`.
///
/// # Errors
/// For the first line that is wrong, or for the file as a whole.
pub(super) fn prescan(text: &str, limits: MeshLimits) -> Result<Prescan, Refusal> {
    let scan = scan(text, limits, None)?;
    let normals = scan.normals;
    // A file that names normals past its last one is scanned again with their count known. Nearly
    // no file does. A file without any normals may name some, as other loaders allow, and needs no
    // second pass.
    if scan.named_normals > normals && normals > 0 {
        self::scan(text, limits, Some(normals))
    } else {
        Ok(scan)
    }
}

/// Scans all of `text`. `all_normals` is the count of normals if an earlier scan found it.
fn scan(text: &str, limits: MeshLimits, all_normals: Option<usize>) -> Result<Prescan, Refusal> {
    let mut scan = Prescan {
        text: Vec::with_capacity(text.len()),
        limits,
        all_normals,
        ..Prescan::default()
    };
    let mut corners = Vec::new();
    for (line, statement) in Statements::new(text) {
        if let Err(problem) = scan.statement(line, &statement, &mut corners) {
            return Err(scan.refusal(Some(line), problem));
        }
    }
    if let Some((line, problem)) = scan.wrong_index() {
        return Err(scan.refusal(Some(line), problem));
    }
    scan.check_colours();
    for normal in 0..scan.unused_normals.len().min(scan.normals) {
        match scan.unused_normals[normal] {
            0 => {}
            line => {
                let text = "a normal that no face uses is ignored";
                scan.count(line as usize, "normal-unused", text);
            }
        }
    }
    scan.remove_implied_notes();
    match scan.polygons {
        // A stray NUL in a text does no harm. Together with unknown words it shows that the file is
        // not text.
        0 if scan.notes.has(UNKNOWN) && text.contains('\0') => {
            let at = text.find('\0').unwrap_or_default();
            Err(Refusal {
                line: Some(line_number(text, at)),
                problem: ObjProblem::NotText,
                notes: Notes::default(),
            })
        }
        0 if scan.is_library => {
            let what = "a material library, not the mesh that names it";
            Err(scan.refusal(None, ObjProblem::OtherFile(what)))
        }
        0 if scan.notes.has(POINTS_OR_LINES) => {
            Err(scan.refusal(None, ObjProblem::OnlyPointsOrLines))
        }
        0 => Err(scan.refusal(None, ObjProblem::NoPolygons)),
        _ => Ok(scan),
    }
}

impl Prescan {
    /// True if any corner has a normal.
    pub(super) fn has_normals(&self) -> bool {
        self.normals > 0 && self.corners_with_normal > 0
    }

    /// True if the colours that faces use look like values from 0 to 255.
    pub(super) fn has_colours_like_bytes(&self) -> bool {
        let colours = self.used_positions.iter().map(|&at| self.colour(at));
        self.notes.has(COLOUR_OUT_OF_RANGE) && look_like_bytes(colours)
    }

    /// Returns the colours of the positions that faces use, in the order of the parser's mesh;
    /// `None` if any has no colour.
    pub(super) fn used_colours(&self) -> Option<Vec<Vec3>> {
        // A surface cannot reflect less than nothing.
        let colour = |&at: &u32| self.colour(at).max(Vec3::ZERO);
        let colours = self.used_positions.iter().map(colour);
        let is_whole = !self.colours.is_empty() && !self.notes.has(WITHOUT_COLOUR);
        is_whole.then(|| colours.collect())
    }

    fn colour(&self, position: u32) -> Vec3 {
        let colour = self.colours.get(position as usize);
        colour.copied().unwrap_or(NO_COLOUR)
    }

    /// Makes the refusal for `problem`, with all notes so far.
    fn refusal(&mut self, line: Option<usize>, problem: ObjProblem) -> Refusal {
        // The error itself reports the position, so a note about it would repeat it.
        if let ObjProblem::BadPosition { .. } = problem {
            self.notes.remove(BAD_POSITION);
        }
        self.remove_implied_notes();
        Refusal {
            line,
            problem,
            notes: take(&mut self.notes),
        }
    }

    /// Returns the first line that refers to a position that the file does not have, or that holds
    /// a bad position which a face uses, and the problem.
    fn wrong_index(&self) -> Option<(usize, ObjProblem)> {
        let face = |bad: &BadPosition| {
            let face = self.first_uses.get(bad.index).copied();
            face.filter(|&face| face > 0).map(|face| face as usize)
        };
        let bad_position = self.bad_positions.iter().find_map(|bad| {
            let (face, problem) = (face(bad)?, bad.problem.clone());
            Some((bad.line, ObjProblem::BadPosition { problem, face }))
        });
        let wrong = [bad_position, self.positions.missing()];
        wrong.into_iter().flatten().min_by_key(|(line, _)| *line)
    }

    /// Checks the colours of the positions that faces use. If none has a colour, the file counts as
    /// a file without colours.
    fn check_colours(&mut self) {
        let mut used = self.used_positions.iter();
        if used.all(|&position| self.colour(position).is_nan()) {
            self.colours.clear();
            return;
        }
        for i in 0..self.used_positions.len() {
            let position = self.used_positions[i];
            let face = self.first_uses[position as usize] as usize;
            let colour = self.colour(position);
            if colour.is_nan() {
                let text = "a face uses a position that has no colour: the colours of the others are not used";
                self.count(face, WITHOUT_COLOUR, text);
            } else if colour.min_element() < 0.0 || colour.max_element() > 1.0 {
                let text = "a face uses a position whose colour is not within 0 to 1: what is shown is clamped at each pixel";
                self.count(face, COLOUR_OUT_OF_RANGE, text);
            }
        }
    }

    /// Removes the notes that follow from others.
    fn remove_implied_notes(&mut self) {
        let (normals, notes) = (self.normals, &mut self.notes);
        if notes.has(WITHOUT_COLOUR) {
            notes.remove(COLOUR_OUT_OF_RANGE);
        }
        match normals {
            0 => notes.remove(NO_NORMAL),
            _ => notes.remove(UNDECLARED_NORMAL),
        }
        if self.texture_coordinates == 0 && notes.has(UNDECLARED_NORMAL) {
            notes.remove(NO_TEXTURE_COORDINATE);
        }
    }

    /// Counts a case of a kind, whose note is a warning with this text.
    fn count(&mut self, line: usize, kind: &'static str, text: &'static str) {
        self.notes.count(kind, line, || Note::warning(kind, text));
    }

    fn statement(
        &mut self,
        line: usize,
        statement: &str,
        corners: &mut Vec<ObjCorner>,
    ) -> Result<(), ObjProblem> {
        let (written, rest) = keyword(statement);
        let mut word = Cow::Borrowed(written);
        if word.bytes().any(|byte| byte.is_ascii_uppercase()) {
            word = Cow::Owned(written.to_ascii_lowercase());
        }
        match &*word {
            "v" => self.position(line, rest),
            "vn" => {
                // The parser's first normal is a zero that stands for none: see `write_face`.
                if self.normals == 0 {
                    self.text.extend_from_slice(b"vn 0 0 0\n");
                }
                let mut words = without_comment(rest).split_ascii_whitespace();
                if self.vector("vn", &mut words).is_err() {
                    let text = "a normal is not three finite numbers: corners that name it count as without a normal";
                    self.count(line, "normal-not-finite", text);
                }
                self.text.push(b'\n');
                self.normals += 1;
                self.note_normal(self.normals - 1, line);
            }
            "vt" => self.texture_coordinates += 1,
            // Version 2 of the format wrote faces as `fo`.
            "f" | "fo" => self.face(line, rest, corners)?,
            "usemtl" => self.material_runs.push((self.polygons, rest.into())),
            "mtllib" => self.libraries.push((line, rest.into())),
            "o" => self.object_runs.push((self.polygons, rest.into())),
            "s" => {
                let group = self.smoothing_group(line, without_comment(rest));
                self.smoothing_runs.push((self.polygons, group));
            }
            "p" | "l" => self.notes.count(POINTS_OR_LINES, line, points_or_lines),
            // Group names, textures, levels of detail and display settings do not change a picture
            // of polygons.
            "g" | "mg" | "usemap" | "maplib" | "bevel" | "c_interp" | "d_interp" | "lod"
            | "shadow_obj" | "trace_obj" => {}
            "call" | "csh" => {
                let text = "`call` and `csh` are not followed: the geometry that they would add is missing";
                self.count(line, "statement-call", text);
            }
            "#mrgb" => {
                let text = "polypaint (`#MRGB`, colours in comments) is not read";
                self.count(line, "colours-polypaint", text);
            }
            word if word.is_empty() || word.starts_with('#') => {}
            word if FREE_FORM.contains(&word) => {
                let text = "free-form curves and surfaces are not read, only polygons";
                self.count(line, "statement-free-form", text);
            }
            _ => self.unknown_statement(line, written),
        }
        Ok(())
    }

    /// Writes the first three of `words` for the parser. If they are not finite numbers, it writes
    /// three NaNs instead.
    ///
    /// # Errors
    /// If they are not finite numbers. The wrong word is the last one consumed from `words`.
    fn vector(
        &mut self,
        keyword: &str,
        words: &mut SplitAsciiWhitespace,
    ) -> Result<(), VectorProblem> {
        let start = self.text.len();
        let mut problem = None;
        self.text.extend_from_slice(keyword.as_bytes());
        for found in 0..3 {
            let Some(word) = words.next() else {
                problem = Some(VectorProblem::TooFewNumbers { found });
                break;
            };
            // The parser computes the value. Most words plainly are numbers, and need not be parsed
            // here as well.
            if !is_plain_number(word) && !word.parse().is_ok_and(f32::is_finite) {
                let found = quote(word);
                problem = Some(VectorProblem::BadNumber { found });
                break;
            }
            self.text.push(b' ');
            self.text.extend_from_slice(word.as_bytes());
        }
        let Some(problem) = problem else {
            return Ok(());
        };
        self.text.truncate(start);
        self.text.extend_from_slice(keyword.as_bytes());
        self.text.extend_from_slice(b" nan nan nan");
        Err(problem)
    }

    /// Notes a word that is not a statement. Of several, the note quotes the first.
    fn unknown_statement(&mut self, line: usize, word: &str) {
        self.notes.count(UNKNOWN, line, || {
            self.is_library = word.eq_ignore_ascii_case("newmtl");
            let word = quote(word);
            let text = format!("`{word}` is not an OBJ statement and is ignored");
            Note::warning(UNKNOWN, text)
        });
    }

    /// Reads a position: three numbers, then a colour (three more) or a weight (one more), which is
    /// ignored. Words after a colour are not checked.
    fn position(&mut self, line: usize, rest: &str) {
        let mut words = without_comment(rest).split_ascii_whitespace();
        let read = self.vector("v", &mut words);
        if let Err(problem) = read.and_then(|()| self.colour_or_weight(line, &mut words)) {
            let text = "a position is not three finite numbers and is left out";
            self.count(line, BAD_POSITION, text);
            self.bad_positions.push(BadPosition {
                index: self.positions.count,
                line,
                problem,
            });
        }
        self.text.push(b'\n');
        self.positions.count += 1;
    }

    /// Reads the words after the three numbers of a position.
    ///
    /// # Errors
    /// If one of them is not a number. Two lines that ran together must not count as a position.
    fn colour_or_weight(
        &mut self,
        line: usize,
        words: &mut SplitAsciiWhitespace,
    ) -> Result<(), VectorProblem> {
        let mut values = [f32::NAN; 3];
        let mut found = 0;
        for (value, word) in values.iter_mut().zip(words) {
            let problem = || VectorProblem::BadNumber { found: quote(word) };
            *value = read_number(word).ok_or_else(problem)?;
            found += 1;
        }
        let colour = Vec3::from_array(values);
        if found == 1 && values[0] != 1.0 {
            let text = "the weight w of a position is ignored";
            self.count(line, "position-weight", text);
        }
        if found == 3 && colour.is_finite() {
            self.colours.resize(self.positions.count, NO_COLOUR);
            self.colours.push(colour);
        }
        Ok(())
    }

    fn face(
        &mut self,
        line: usize,
        rest: &str,
        corners: &mut Vec<ObjCorner>,
    ) -> Result<(), ObjProblem> {
        let words = without_comment(rest).split_ascii_whitespace();
        // A face of fewer than three words is left out whatever it names. Its indices are not
        // checked, as the file may be cut off here.
        if words.clone().nth(2).is_none() {
            // A word with backslashes, as in `f 1\2\3`, is not cut off but wrong.
            if let Some(word) = words.clone().find(|word| word.contains('\\')) {
                self.corner(line, word)?;
            }
            count_small_face(&mut self.notes, line);
            return Ok(());
        }
        corners.clear();
        for word in words {
            corners.push(self.corner(line, word)?);
        }
        let written = corners.len();
        corners.dedup_by_key(|corner| corner.position);
        while corners.len() > 1 && corners[0].position == corners[corners.len() - 1].position {
            corners.pop();
        }
        if corners.len() < 3 {
            count_small_face(&mut self.notes, line);
            return Ok(());
        }
        if corners.len() < written {
            count_repeated_corner(&mut self.notes, line);
        }
        if self.polygons == self.limits.polygons {
            return Err(ObjProblem::TooManyPolygons);
        }
        if corners.len() > self.limits.corners - self.corners {
            return Err(ObjProblem::TooManyCorners);
        }
        self.polygons += 1;
        self.corners += corners.len();
        self.note_uses(line, corners);
        self.write_face(corners);
        Ok(())
    }

    /// Records the positions that a face in `line` is the first to use.
    fn note_uses(&mut self, line: usize, corners: &[ObjCorner]) {
        let line = u32::try_from(line).unwrap_or(u32::MAX);
        for position in corners.iter().map(|corner| corner.position) {
            if position >= self.first_uses.len() {
                // The file is too short for that many positions, so this one will turn out to be
                // missing. Memory must not grow for it.
                if position >= self.text.capacity().max(self.positions.count) {
                    continue;
                }
                self.first_uses.resize(position + 1, 0);
            }
            if self.first_uses[position] == 0 {
                self.first_uses[position] = line;
                self.used_positions.push(position as u32);
            }
        }
    }

    /// Records the line of a normal; line 0 records that a face names it, which may happen before
    /// or after its line.
    fn note_normal(&mut self, normal: usize, line: usize) {
        if normal >= self.unused_normals.len() {
            // The file is too short for that many normals: see `note_uses`.
            if normal >= self.text.capacity().max(self.normals) {
                return;
            }
            self.unused_normals.resize(normal + 1, u32::MAX);
        } else if self.unused_normals[normal] == 0 {
            return;
        }
        self.unused_normals[normal] = u32::try_from(line).unwrap_or(u32::MAX);
    }

    /// Writes a face for the parser. The parser's first normal is zero and means none, so the
    /// file's normals are shifted by one.
    ///
    /// A corner without a normal gets that first normal. As long as no corner had a normal, nothing
    /// is written: the parser then uses its first normal by itself, and the text stays short for
    /// files without normals.
    fn write_face(&mut self, corners: &[ObjCorner]) {
        self.text.push(b'f');
        for corner in corners {
            push_decimal(&mut self.text, b" ", corner.position + 1);
            if let Some(normal) = corner.normal {
                push_decimal(&mut self.text, b"//", normal + 2);
                self.corners_with_normal += 1;
                self.note_normal(normal, 0);
            } else if self.corners_with_normal > 0 {
                self.text.extend_from_slice(b"//1");
            }
        }
        self.text.push(b'\n');
    }

    /// Returns the smoothing group of an `s` statement with the arguments `rest`: 0 for `off`, 1
    /// for `on`.
    fn smoothing_group(&mut self, line: usize, rest: &str) -> u64 {
        let word = rest.split_ascii_whitespace().next().unwrap_or_default();
        match (word.parse(), &*word.to_ascii_lowercase()) {
            (Ok(group), _) => group,
            (_, "on") => 1,
            (_, "off" | "null") => 0,
            _ => {
                let kind = "statement-no-smoothing-group";
                self.notes.count(kind, line, || {
                    let word = quote(word);
                    Note::warning(
                        kind,
                        format!("`s {word}` is not a smoothing group and counts as `off`: expected a whole number from 0 on, `on` or `off`"),
                    )
                });
                0
            }
        }
    }

    fn corner(&mut self, line: usize, word: &str) -> Result<ObjCorner, ObjProblem> {
        let written = WrittenCorner::read(word)?;
        if let Some(index) = written.texture
            && (index == 0 || index.unsigned_abs() > self.texture_coordinates as u64)
        {
            let text = "a texture coordinate that does not exist is ignored, as all of them are";
            self.count(line, NO_TEXTURE_COORDINATE, text);
        }
        let position = self.positions.resolve(line, written.position)?;
        let normal = written.normal.and_then(|index| self.normal(line, index));
        Ok(ObjCorner { position, normal })
    }

    /// Returns the normal, counted from 0, for a written `index`. If there is none, it notes that
    /// and returns `None`.
    fn normal(&mut self, line: usize, index: i64) -> Option<usize> {
        if self.normals == 0 {
            let text = "a face names normals or texture coordinates, but the file has none: they are ignored";
            self.count(line, UNDECLARED_NORMAL, text);
        }
        let size = usize::try_from(index.unsigned_abs()).ok();
        let named = size.and_then(|size| match index {
            ..0 => self.normals.checked_sub(size),
            _ => size.checked_sub(1),
        });
        let named = named.filter(|named| self.all_normals.is_none_or(|all| *named < all));
        match named {
            Some(named) => self.named_normals = self.named_normals.max(named.saturating_add(1)),
            None => {
                let text =
                    "a corner names a normal that does not exist and counts as without a normal";
                self.count(line, NO_NORMAL, text);
            }
        }
        named
    }
}

/// Appends a separator and `index`, which must not be 0, in decimal. It is faster than `write!`,
/// and each corner needs it once or twice.
fn push_decimal(text: &mut Vec<u8>, separator: &[u8], mut index: usize) {
    // 20 digits hold every 64-bit number. They are filled from the last one on.
    let mut digits = [0; 20];
    let mut start = digits.len();
    while index > 0 {
        start -= 1;
        digits[start] = b'0' + (index % 10) as u8;
        index /= 10;
    }
    text.extend_from_slice(separator);
    text.extend_from_slice(&digits[start..]);
}
