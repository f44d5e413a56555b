//! Are the two projections true to scale, and to each other?

use super::*;

#[test]
fn both_views_show_one_x_in_one_column() {
    for width in 60..=200 {
        for (pan, zoom) in [(0.0, 1.0), (0.77, 1.0), (-1.1, 2.5)] {
            let mut scene = stages::scene("plane", &[]);
            let plane = stages::wall(dvec3(0.4, 5.0, 0.0), dvec3(0.0, 99.0, 0.0), dvec3(0.0, 0.0, 99.0), None);
            stages::edit(&mut scene, |stage| stage.walls = vec![plane]);
            (scene.view_settings.pan.x, scene.view_settings.zoom, scene.view_settings.marker) =
                (pan, zoom, Marker::Ascii);
            let frame = text(&scene, width, 24);
            let lines: Vec<&str> = frame.lines().collect();
            let right = lines[1].find(" top-down").expect("the label of the right view");
            let columns: Vec<usize> =
                lines[4].match_indices(['|', '(', ')']).map(|(column, _)| column).take(2).collect();
            assert_eq!(columns[1] - columns[0], right, "at width {width}:\n{frame}");
        }
    }
}

#[test]
fn a_metre_is_as_long_across_as_down_in_both_views() {
    let mut scene = stages::scene("square", &[]);
    let square = |normal: DVec3| {
        let edges = if normal.z == 1.0 { (DVec3::X * 4.0, DVec3::Y * 4.0) } else { (DVec3::X * 4.0, DVec3::Z * 4.0) };
        stages::wall(dvec3(0.0, 5.0, 0.0), edges.0, edges.1, None)
    };
    for normal in [DVec3::Z, DVec3::Y] {
        stages::edit(&mut scene, |stage| stage.walls = vec![square(normal)]);
        scene.view_settings.views = if normal.z == 1.0 { Views::Side } else { Views::Top };
        for (width, height) in [(80, 24), (60, 40), (109, 60)] {
            let frame = text(&scene, width, height);
            let rows: Vec<&str> =
                frame.lines().skip(2).take(usize::from(height) - 4).filter(|row| !row.is_empty()).collect();
            let across = rows[0].trim().chars().count();
            // A cell is twice as high as wide; each side may lose or gain a cell by where it begins.
            assert!(across.abs_diff(2 * rows.len()) <= 3, "{across} columns, {} rows:\n{frame}", rows.len());
        }
    }
}

#[test]
fn the_followed_sphere_stays_in_the_middle() {
    let mut scene = stages::scene("follow", &[(dvec3(3.0, 2.0, 0.0), DVec3::ZERO)]);
    stages::edit(&mut scene, |stage| stage.walls.clear());
    (scene.view_settings.selected, scene.view_settings.follow, scene.view_settings.zoom) = (Some(0), true, 8.0);
    let here = text(&scene, 80, 24);
    scene.snapshot.x[0] = dvec3(-1e3, 77.0, 5.0);
    assert_eq!(text(&scene, 80, 24), here);
}
