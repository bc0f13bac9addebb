//! How many operations each method takes, as a table.

use super::html::escape;
use crate::number::Counts;
use crate::shading::{METHODS, OperationCounts};
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// What a rate is called, and its operations.
type Rate = (&'static str, fn(&OperationCounts) -> Counts);

/// The rates at which operations are carried out, in the order of the columns.
pub(super) const RATES: [Rate; 7] = [
    ("vertex", |c| c.vertex),
    ("polygon", |c| c.polygon),
    ("edge", |c| c.edge),
    ("edge, scanline", |c| c.edge_step),
    ("span", |c| c.span),
    ("pixel: walk", |c| c.walk),
    ("pixel: shade", |c| c.shade),
];

/// How the operations are abbreviated in cells.
pub(super) const LEGEND: &str = "+ additions and subtractions, × multiplications, ÷ divisions, √ square roots, \
                                 < comparisons, ∿ sines, cosines and inverse tangents, ^ powers. Counted by running \
                                 each method on numbers that count, for shininess 32.";

/// The numbers of lights that are counted for.
pub(super) const LIGHTS: [usize; 2] = [1, 4];

/// `14 + · 9 ×`, or nothing for nothing.
pub(super) fn cell(counts: &Counts) -> String {
    let kinds = [
        (counts.additions, '+'),
        (counts.multiplications, '×'),
        (counts.divisions, '÷'),
        (counts.roots, '√'),
        (counts.comparisons, '<'),
        (counts.trigonometric, '∿'),
        (counts.powers, '^'),
    ];
    // A space that does not break keeps a number with its sign.
    let parts: Vec<String> = kinds
        .iter()
        .filter(|(n, _)| *n > 0)
        .map(|(n, sign)| format!("{n}\u{A0}{sign}"))
        .collect();
    if parts.is_empty() {
        "–".to_string()
    } else {
        parts.join(" ")
    }
}

/// The table of all methods, for one light and for four.
pub(super) fn html() -> String {
    let mut html =
        String::from("<thead><tr><th scope=\"col\">method</th><th scope=\"col\">lights</th>");
    for (rate, _) in RATES {
        html += &format!("<th scope=\"col\">{rate}</th>");
    }
    html += "</tr></thead>";
    for entry in METHODS {
        html += "<tbody>";
        for (i, lights) in LIGHTS.into_iter().enumerate() {
            let operations = entry.variant().operations(lights);
            html += "<tr>";
            if i == 0 {
                html += &format!(
                    "<th scope=\"rowgroup\" rowspan=\"{}\">{}</th>",
                    LIGHTS.len(),
                    escape(entry.info.name)
                );
            }
            html += &format!("<td class=\"number\">{lights}</td>");
            for (_, counts) in RATES {
                html += &format!("<td>{}</td>", escape(&cell(&counts(&operations))));
            }
            html += "</tr>";
        }
        html += "</tbody>";
    }
    html
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_tell_what_there_is() {
        let counts = Counts {
            additions: 14,
            multiplications: 9,
            roots: 1,
            ..Counts::default()
        };
        assert_eq!(cell(&counts), "14\u{A0}+ 9\u{A0}× 1\u{A0}√");
        assert_eq!(cell(&Counts::default()), "–");
    }

    #[test]
    fn every_method_has_a_row_for_each_number_of_lights() {
        let html = html();
        assert_eq!(
            html.matches("<tr>").count(),
            1 + METHODS.len() * LIGHTS.len()
        );
        for entry in METHODS {
            assert!(html.contains(&format!(">{}</th>", entry.info.name)));
        }
        // Naive Phong takes one root and one division a pixel.
        assert!(html.contains("1\u{A0}√"));
    }
}
