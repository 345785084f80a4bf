//! Offsets as JSON: a document of this program, or loops as anyone can write them.

use crate::exit::Exit;
use crate::failure::Failure;
use medial::io::json::{Document, FORMAT};
use medial::{ArcSpline, Units};
use serde::Deserialize;
use std::fs;
use std::path::Path;

/// What is said about a text in another form.
const FORM: &str =
    "write {\"units\": \"mm\", \"loops\": [[[x, y, bulge], [x, y], ...], ...]}, or -o theirs.json of pocket";

/// Loops as a file has them, each with its distance where the file knows it.
#[derive(Debug, PartialEq)]
pub struct Loops {
    pub units: Option<Units>,
    pub curves: Vec<(Option<f64>, ArcSpline)>,
}

/// Loops as anyone can write them.
#[derive(Deserialize)]
#[serde(untagged)]
enum Plain {
    Object { units: Option<Units>, loops: Vec<PlainLoop> },
    List(Vec<PlainLoop>),
}

#[derive(Deserialize)]
#[serde(untagged)]
enum PlainLoop {
    Object { vertices: Vec<Vec<f64>> },
    List(Vec<Vec<f64>>),
}

/// Reads a file.
pub fn read(path: &Path) -> Result<Loops, Failure> {
    let bytes = fs::read(path).map_err(|cause| {
        Failure::from(medial::Error::File { action: "read", path: path.display().to_string(), cause })
    })?;
    parse(&bytes).map_err(|reason| Failure {
        exit: Exit::Cannot,
        message: format!("{} holds no offsets that can be read: {reason}", path.display()),
        at: None,
        help: Some(FORM.into()),
    })
}

fn parse(bytes: &[u8]) -> Result<Loops, String> {
    let value: serde_json::Value = serde_json::from_slice(bytes).map_err(|e| e.to_string())?;
    match value.get("format").map(|f| f.as_str() == Some(FORMAT)) {
        Some(true) => serde_json::from_value(value).map(of_document).map_err(|e| e.to_string()),
        Some(false) => Err(format!("its format is not {FORMAT}")),
        None => match serde_json::from_value(value) {
            Ok(Plain::Object { units, loops }) => of_plain(units, loops),
            Ok(Plain::List(loops)) => of_plain(None, loops),
            Err(_) => Err("it is no list of loops".into()),
        },
    }
}

fn of_document(document: Document) -> Loops {
    let offsets = document.pockets.into_iter().flat_map(|p| p.offsets);
    let curves = offsets.flat_map(|o| {
        let loops = o.loops.into_iter().map(|l| ArcSpline { vertices: l.vertices, closed: true });
        let ridges = o.ridges.into_iter().map(|r| ArcSpline { vertices: r.vertices, closed: r.closed });
        loops.chain(ridges).map(move |spline| (Some(o.distance), spline))
    });
    Loops { units: Some(document.units), curves: curves.collect() }
}

fn of_plain(units: Option<Units>, loops: Vec<PlainLoop>) -> Result<Loops, String> {
    let curve = |l: PlainLoop| {
        let (PlainLoop::Object { vertices } | PlainLoop::List(vertices)) = l;
        let vertex = |v: Vec<f64>| match v[..] {
            [x, y] => Ok((x, y, 0.0)),
            [x, y, bulge] => Ok((x, y, bulge)),
            _ => Err(format!("a vertex has {} numbers, not two or three", v.len())),
        };
        let vertices = vertices.into_iter().map(vertex).collect::<Result<Vec<_>, _>>()?;
        Ok((None, ArcSpline::closed(vertices)))
    };
    Ok(Loops { units, curves: loops.into_iter().map(curve).collect::<Result<_, String>>()? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loops_may_be_written_in_several_ways() {
        let triangle = ArcSpline::closed([(0.0, 0.0, 0.0), (4.0, 0.0, 0.5), (0.0, 3.0, 0.0)]);
        let list = "[[[0,0],[4,0,0.5],[0,3]]]";
        let forms = [list.to_owned(), format!("{{\"loops\":{list}}}")];
        for form in
            forms.iter().map(String::as_str).chain(["{\"loops\":[{\"vertices\":[[0,0],[4,0,0.5],[0,3]]}]}"])
        {
            let read = parse(form.as_bytes()).unwrap();
            assert_eq!(read, Loops { units: None, curves: vec![(None, triangle.clone())] });
        }
        assert_eq!(parse(b"{\"units\":\"in\",\"loops\":[]}").unwrap().units, Some(Units::Inch));
        assert!(parse(b"[]").unwrap().curves.is_empty());
    }

    #[test]
    fn what_is_no_list_of_loops_is_refused() {
        for bad in
            ["", "{}", "[[[1]]]", "[[1,2]]", "{\"format\":\"medial/9\"}", "{\"format\":\"medial/1\"}", "7"]
        {
            assert!(parse(bad.as_bytes()).is_err(), "{bad}");
        }
    }
}
