//! Binary DXF: what the parser says of its entities, as [`Contents`] has it from text.
//!
//! **Does not** know which layers are frozen, nor kinds that the parser drops.

use super::records::{Contents, Layer, Record};
use ::dxf::entities::{Entity, EntityType};
use ::dxf::enums::AcadVersion;

/// The contents of a parsed file; its entities are records in the same order.
pub(super) fn contents(drawing: &::dxf::Drawing) -> Contents {
    let header = &drawing.header;
    let layers = drawing.layers().map(|l| Layer { name: l.name.clone(), off: !l.is_layer_on, frozen: false });
    Contents {
        insunits: Some(header.default_drawing_units as i64),
        // Older files do not hold the flag, and the parser then answers inches.
        measurement: (header.version >= AcadVersion::R2000).then_some(header.drawing_units as i64),
        layers: layers.collect(),
        records: drawing.entities().map(record).collect(),
        ended: true,
        sections: true,
        geometry: Vec::new(),
    }
}

fn record(entity: &Entity) -> Record {
    let common = &entity.common;
    Record {
        kind: kind(&entity.specific).into(),
        handle: Some(common.handle.0),
        layer: common.layer.clone(),
        paper: common.is_in_paper_space,
        invisible: !common.is_visible,
        fault: None,
    }
}

/// Kind of an entity, as the format calls it.
fn kind(entity: &EntityType) -> &'static str {
    match entity {
        EntityType::Line(_) => "LINE",
        EntityType::Arc(_) => "ARC",
        EntityType::Circle(_) => "CIRCLE",
        EntityType::LwPolyline(_) => "LWPOLYLINE",
        EntityType::Polyline(_) => "POLYLINE",
        EntityType::Spline(_) => "SPLINE",
        EntityType::Ellipse(_) => "ELLIPSE",
        EntityType::Insert(_) => "INSERT",
        EntityType::Helix(_) => "HELIX",
        EntityType::MLine(_) => "MLINE",
        EntityType::Solid(_) => "SOLID",
        EntityType::Trace(_) => "TRACE",
        EntityType::Face3D(_) => "3DFACE",
        EntityType::Region(_) => "REGION",
        EntityType::Solid3D(_) => "3DSOLID",
        EntityType::Text(_) => "TEXT",
        EntityType::MText(_) => "MTEXT",
        EntityType::ModelPoint(_) => "POINT",
        EntityType::RotatedDimension(_)
        | EntityType::RadialDimension(_)
        | EntityType::DiameterDimension(_)
        | EntityType::AngularThreePointDimension(_)
        | EntityType::OrdinateDimension(_) => "DIMENSION",
        EntityType::Leader(_) => "LEADER",
        EntityType::Image(_) => "IMAGE",
        _ => "other entities",
    }
}
