package io.furrow.fields;

import java.util.List;

import org.locationtech.jts.geom.Coordinate;

/**
 * The boundary of a field as read from its file, valid or not: polygons of rings, where the first ring is the shell.
 * Rings need not be closed.
 *
 * @param polygons coordinates in the file's coordinate system, x = easting or longitude
 * @param notes repairs made while reading it, as text
 */
record Outline(List<List<List<Coordinate>>> polygons, List<String> notes) {
    static final String HEIGHTS_LEFT_OUT = "left out heights";
    static final String MEASURES_LEFT_OUT = "left out measures";
}
