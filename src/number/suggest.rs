//! "Did you mean …?": finds the known word nearest to an unknown one.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// Says that there is no `kind` called `name`, and suggests the nearest of the `known` names, or
/// lists all.
pub fn unknown<'a>(kind: &str, name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    match nearest(name, known.iter().copied()) {
        Some(near) => format!("unknown {kind} `{name}`: did you mean `{near}`?"),
        None => format!("unknown {kind} `{name}`: {}", one_of(known)),
    }
}

/// Returns "expected …" with the list of `names`.
pub fn one_of<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.into_iter().map(|name| format!("`{name}`")).collect();
    match &names[..] {
        [one, other] => format!("expected {one} or {other}"),
        all => format!("expected one of {}", all.join(", ")),
    }
}

/// Returns the candidate nearest to `word` if it is near enough, and the first among equally near
/// ones.
///
/// Near enough means at most one slip per three letters of the longer word, and one slip in shorter
/// words. If no candidate is near enough and `word` has four letters or more, returns the first
/// candidate that contains it. Case does not count.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word: Vec<char> = word.chars().flat_map(char::to_lowercase).collect();
    let mut best: Option<(usize, &str)> = None;
    let mut container = None;
    for candidate in candidates {
        let letters: Vec<char> = candidate.chars().flat_map(char::to_lowercase).collect();
        if word.len() >= 4 && letters.windows(word.len()).any(|part| part == word) {
            container = container.or(Some(candidate));
        }
        let allowed = (word.len().max(letters.len()) / 3).max(1);
        // A difference in length already costs that many slips, so a long word need not be compared
        // letter by letter.
        if word.len().abs_diff(letters.len()) > allowed {
            continue;
        }
        let slips = edit_distance(&word, &letters);
        if slips <= allowed && best.is_none_or(|(least, _)| slips < least) {
            best = Some((slips, candidate));
        }
    }
    best.map(|(_, candidate)| candidate).or(container)
}

/// Returns how many letters to insert, delete, replace or swap with their neighbour to turn `a`
/// into `b`.
///
/// This is the optimal string alignment distance, in which no letter is edited twice: Damerau, *A
/// technique for computer detection and correction of spelling errors*, CACM 7 (1964).
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut before = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut row = Vec::with_capacity(b.len() + 1);
        row.push(i + 1);
        for j in 0..b.len() {
            let replaced = above[j] + usize::from(a[i] != b[j]);
            // Delete a letter of `a`, or insert one of `b`.
            let mut least = replaced.min(above[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                // Two neighbours change places: continue from two rows above.
                let two_above: &Vec<usize> = &before;
                least = least.min(two_above[j - 1] + 1);
            }
            row.push(least);
        }
        before = core::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn distance(a: &str, b: &str) -> usize {
        edit_distance(
            &a.chars().collect::<Vec<_>>(),
            &b.chars().collect::<Vec<_>>(),
        )
    }

    #[test]
    fn distances() {
        for (a, b, slips) in [
            ("", "", 0),
            ("", "abc", 3),
            ("kitten", "sitting", 3),
            ("teapot", "taepot", 1),
            ("sphere", "shpere", 1),
            ("flaw", "lawn", 2),
            ("torus", "torus", 0),
        ] {
            assert_eq!((distance(a, b), distance(b, a)), (slips, slips), "{a} {b}");
        }
    }

    #[test]
    fn only_near_words_are_suggested() {
        let words = ["sphere", "torus", "teapot", "knot"];
        assert_eq!(nearest("Spheer", words), Some("sphere"));
        assert_eq!(nearest("taepot", words), Some("teapot"));
        assert_eq!(nearest("not", words), Some("knot"));
        assert_eq!(nearest("bunny", words), None);
        assert_eq!(
            nearest("phong", ["flat", "naive-phong", "phong-rsqrt"]),
            Some("naive-phong")
        );
        assert_eq!(nearest("pot", words), None, "too short to be a part");
        assert_eq!(nearest("", words), None);
        assert_eq!(nearest("abc", []), None);
    }
}
