package io.furrow.control.field;

import java.util.List;

import org.locationtech.jts.geom.Coordinate;

/**
 * The border of a field as its file has it, broken or not: polygons of rings, the first of each its shell. Rings need not be
 * closed.
 *
 * @param polygons coordinates in the file's coordinate system, x = easting or longitude
 * @param notes what had to be mended to read it, in words
 */
record Outline(List<List<List<Coordinate>>> polygons, List<String> notes) {
    static final String HEIGHTS_LEFT_OUT = "left out heights";
    static final String MEASURES_LEFT_OUT = "left out measures";
}
