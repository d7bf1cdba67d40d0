package io.furrow.fields;

import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

import org.locationtech.jts.geom.Coordinate;

import io.furrow.model.field.InvalidFileException;
import io.furrow.model.text.Counts;

/** Reads the main file of a Shapefile (.shp), as specified by "ESRI Shapefile Technical Description", July 1998. */
record ShapefileReader(Path file, ByteBuffer bytes) {
    private static final int FILE_CODE = 9994;
    private static final int FILE_HEADER = 100;
    private static final int RECORD_HEADER = 8;
    private static final int BOX = 32;
    private static final int POINT = 16;

    private static final int NULL_SHAPE = 0;
    private static final int POLYGON = 5;
    private static final int POLYGON_Z = 15;
    private static final int POLYGON_M = 25;

    /** The content of a record; {@code fault} says why there is no outline. */
    record Shape(Outline outline, String fault) {}

    static List<Shape> read(Path file) throws InvalidFileException {
        ByteBuffer bytes;
        try {
            bytes = ByteBuffer.wrap(Files.readAllBytes(file));
        } catch (IOException e) {
            throw new InvalidFileException(file, e);
        }
        if (bytes.remaining() < FILE_HEADER || bytes.getInt(0) != FILE_CODE) {
            throw new InvalidFileException(file + " is not a Shapefile: it does not begin with the code 9994");
        }
        return new ShapefileReader(file, bytes.position(FILE_HEADER)).all();
    }

    private List<Shape> all() throws InvalidFileException {
        List<Shape> shapes = new ArrayList<>();
        while (bytes.remaining() >= RECORD_HEADER) {
            bytes.order(ByteOrder.BIG_ENDIAN).getInt();
            int length = 2 * bytes.getInt();
            if (length < 4 || length > bytes.remaining()) {
                throw new InvalidFileException(
                        "%s is truncated in record %d; copy it again".formatted(file, shapes.size() + 1));
            }
            ByteBuffer content = bytes.slice(bytes.position(), length).order(ByteOrder.LITTLE_ENDIAN);
            shapes.add(shape(content));
            bytes.position(bytes.position() + length);
        }
        return shapes;
    }

    private static Shape shape(ByteBuffer content) {
        int type = content.getInt();
        return switch (type) {
            case NULL_SHAPE -> new Shape(null, "has no geometry");
            case POLYGON, POLYGON_Z, POLYGON_M -> polygon(content, type);
            default -> new Shape(null, "is a shape of type " + type + "; a field is a polygon (type 5, 15 or 25)");
        };
    }

    private static Shape polygon(ByteBuffer content, int type) {
        if (content.remaining() < BOX + 8) {
            return new Shape(null, "is truncated before its corners");
        }
        content.position(content.position() + BOX);
        int parts = content.getInt();
        int points = content.getInt();
        if (parts < 0 || points < 0 || 4L * parts + (long) POINT * points > content.remaining()) {
            return new Shape(null, "is truncated: some of its %d corners are missing".formatted(points));
        }
        int[] starts = new int[parts + 1];
        for (int part = 0; part < parts; part++) {
            starts[part] = content.getInt();
        }
        starts[parts] = points;
        List<List<Coordinate>> rings = new ArrayList<>();
        for (int part = 0; part < parts; part++) {
            boolean isInOrder = starts[part] <= starts[part + 1] && starts[part + 1] <= points;
            if (!isInOrder || starts[0] != 0) {
                return new Shape(null, "has rings whose start indices are not in order");
            }
            rings.add(ring(content, starts[part + 1] - starts[part]));
        }
        List<List<List<Coordinate>>> polygons = Rings.nested(rings);
        return new Shape(new Outline(polygons, notes(polygons, type)), null);
    }

    private static List<Coordinate> ring(ByteBuffer content, int corners) {
        List<Coordinate> ring = new ArrayList<>(corners);
        for (int corner = 0; corner < corners; corner++) {
            ring.add(new Coordinate(content.getDouble(), content.getDouble()));
        }
        return ring;
    }

    private static List<String> notes(List<List<List<Coordinate>>> polygons, int type) {
        List<String> notes = new ArrayList<>();
        if (type != POLYGON) {
            notes.add(type == POLYGON_Z ? Outline.HEIGHTS_LEFT_OUT : Outline.MEASURES_LEFT_OUT);
        }
        int reversed = Rings.countReversed(polygons, false);
        if (reversed > 0) {
            notes.add("distinguished shells from holes by their position, because " + Counts.of(reversed, "ring")
                    + " had the wrong orientation");
        }
        return notes;
    }
}
