//! The page of compared pictures: each pair with the map of its difference, failed pairs first.
//!
//! Its parts are in `report/pairs` and `report/script/pairs.js`. It shares style and viewer with
//! the report.

use super::page::{filled, script};
use super::pictures::data_uri;
use crate::compare::table::html_text;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use fastphong::compare::metrics::judgement::LargestRegion;
use fastphong_report::{PAIRS_STYLE, PAIRS_TEMPLATE, STYLE, VIEWER};
use serde_json::json;

/// The contents of the page.
#[derive(Clone, Debug, Default)]
pub struct PairsPage {
    /// How many pairs there are of each kind, as text.
    pub title: String,
    /// A text that says what was compared.
    pub about: String,
    /// Grey levels at the light end of the maps.
    pub levels: f32,
    /// The pairs, in the order of the page.
    pub pairs: Vec<ShownPair>,
}

/// How many bytes of markup a pair has, at most, if its texts need none.
const MARKUP: usize = 1500;

/// A pair of pictures on the page. Pictures are PNG files, and empty if there is none.
#[derive(Clone, Debug, Default)]
pub struct ShownPair {
    /// The name of both pictures.
    pub name: String,
    /// The result, in one word.
    pub status: &'static str,
    /// True if this pair makes the comparison fail.
    pub fails: bool,
    /// The result in a line.
    pub text: String,
    /// Facts about the files.
    pub notes: Vec<String>,
    /// Width and height on the page.
    pub size: [usize; 2],
    /// How many columns and rows of the pictures become one pixel on the page.
    pub step: usize,
    /// The reference.
    pub reference: Vec<u8>,
    /// The picture.
    pub actual: Vec<u8>,
    /// The map of their difference.
    pub map: Vec<u8>,
    /// The largest difference in grey levels.
    pub largest: Option<f64>,
    /// Column and row of the first pixel with the largest difference.
    pub worst: Option<[usize; 2]>,
    /// The largest region of pixels over the threshold.
    pub region: Option<LargestRegion>,
    /// The region's place, in one line.
    pub region_text: String,
}

impl PairsPage {
    /// Writes the page.
    pub fn html(&self) -> String {
        let html = |is_equal: bool| {
            let pairs = self
                .pairs
                .iter()
                .enumerate()
                .filter(|(_, pair)| (pair.status == "equal") == is_equal);
            pairs.map(|(i, pair)| pair.html(i)).collect::<String>()
        };
        let parts = [
            ("title", html_text(&self.title)),
            ("style", STYLE.to_string() + PAIRS_STYLE),
            ("about", html_text(&self.about)),
            ("levels", self.levels.to_string()),
            ("pairs", html(false)),
            ("equal", html(true)),
            ("viewer", VIEWER.to_string()),
            ("script", script("pairs.js")),
        ];
        filled(PAIRS_TEMPLATE, &parts)
    }
}

impl ShownPair {
    /// Returns about how many bytes of a page it takes.
    pub fn bytes(&self) -> usize {
        let pictures = [&self.reference, &self.actual, &self.map];
        // Base64 writes three bytes as four letters.
        let pictures: usize = pictures.map(|png| png.len().div_ceil(3) * 4).iter().sum();
        let texts = [&self.name, &self.text, &self.region_text];
        let texts: usize = texts.into_iter().chain(&self.notes).map(String::len).sum();
        MARKUP + pictures + texts
    }

    fn html(&self, index: usize) -> String {
        let name = html_text(&self.name);
        let pictures = [
            ("reference", &self.reference),
            ("actual", &self.actual),
            ("map", &self.map),
        ];
        let there = pictures.iter().filter(|(_, png)| !png.is_empty());
        let shots: String = there
            .map(|(kind, png)| self.shot(kind, png, pictures[1].1.is_empty()))
            .collect();
        // The viewer opens only pairs with all three pictures.
        let worst = self
            .worst
            .map(|at| at.map(|place| place / self.step.max(1)));
        let data = json!({ "size": self.size, "largest": self.largest, "worst": worst });
        let data = html_text(&data.to_string());
        let opens = if self.map.is_empty() {
            ""
        } else {
            "<button class=\"opens\">Open</button>"
        };
        let chip = if self.fails {
            "contradicts"
        } else {
            "confirms"
        };
        let hints: String = self
            .notes
            .iter()
            .chain([&self.region_text])
            .filter(|text| !text.is_empty())
            .map(|text| format!("<p class=\"hint\">{}</p>", html_text(text)))
            .collect();
        format!(
            "<article class=\"card pairing\" id=\"pair-{index}\" data-status=\"{}\" data-fails=\"{}\" data-pair=\"{data}\">\
             <div class=\"pairhead\"><span class=\"chip {chip}\">{}</span><h2>{name}</h2>{opens}</div>\
             <p class=\"sub\">{}</p>{hints}<div class=\"shots\">{shots}</div></article>\n",
            self.status,
            self.fails,
            self.status,
            html_text(&self.text),
        )
    }

    /// Writes a picture, with a frame around the largest region on the map.
    fn shot(&self, kind: &str, png: &[u8], is_alone: bool) -> String {
        let frame = match &self.region {
            Some(region) if kind == "map" => self.frame(region),
            _ => String::new(),
        };
        let label = match (kind, self.status) {
            ("actual", _) => "picture",
            ("map", _) => "difference",
            (_, "equal") if is_alone => "both",
            (kind, _) => kind,
        };
        let [width, height] = self.size;
        format!(
            "<figure class=\"shot\"><div><img class=\"{kind}\" alt=\"{label}\" width=\"{width}\" height=\"{height}\" \
             loading=\"lazy\" decoding=\"async\" src=\"{}\">{frame}</div><figcaption>{label}</figcaption></figure>",
            data_uri(png)
        )
    }

    /// Writes a frame around a region. Its position is in per cent of the picture.
    fn frame(&self, region: &LargestRegion) -> String {
        let part = |axis: usize, pixels: usize| {
            let side = (self.size[axis] * self.step.max(1)) as f64;
            100.0 * pixels as f64 / side
        };
        let ([x, y], [w, h]) = (region.corner, region.size);
        let (left, top) = (part(0, x), part(1, y));
        let (width, height) = (part(0, w), part(1, h));
        format!(
            "<i class=\"frame\" style=\"left:{left:.3}%;top:{top:.3}%;width:{width:.3}%;height:{height:.3}%\"></i>"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_texts_are_no_markup() {
        let pair = ShownPair {
            name: "<script>\"&'.png".into(),
            text: "a < b".into(),
            notes: Vec::from(["</article>".to_string()]),
            ..ShownPair::default()
        };
        let page = PairsPage {
            title: "1 & 2".into(),
            pairs: Vec::from([pair]),
            ..PairsPage::default()
        };
        let html = page.html();
        assert!(html.starts_with("<!doctype html>"));
        assert!(html.contains("&lt;script&gt;") && html.contains("a &lt; b"));
        assert!(html.contains("<title>fastphong: 1 &amp; 2</title>"));
        assert_eq!(html.matches("</article>").count(), 1);
    }
}
