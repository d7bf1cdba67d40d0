package io.furrow.fields;

import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.math.BigDecimal;
import java.nio.charset.Charset;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.ZoneId;
import java.util.ArrayList;
import java.util.Date;
import java.util.List;
import java.util.Locale;
import java.util.Optional;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.node.ObjectNode;
import com.linuxense.javadbf.DBFException;
import com.linuxense.javadbf.DBFReader;

import io.furrow.model.field.InvalidFileException;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;

/**
 * Reads a Shapefile: .shp with .dbf, .prj and .cpg in the same directory. Attributes are decoded with the code page
 * that .cpg or the table names.
 */
final class ShapefileFields {
    private final Path shp;
    private final List<String> notes = new ArrayList<>();

    private ShapefileFields(Path shp) {
        this.shp = shp;
    }

    static FieldLayer read(Path shp) throws InvalidFileException {
        return new ShapefileFields(shp).layer();
    }

    private FieldLayer layer() throws InvalidFileException {
        List<ShapefileReader.Shape> shapes = ShapefileReader.read(shp);
        List<ObjectNode> rows = rows(shapes.size());
        if (rows.size() != shapes.size()) {
            throw new InvalidFileException("%s has %d shapes and %d rows of attributes; copy .shp and .dbf together"
                    .formatted(shp, shapes.size(), rows.size()));
        }
        List<SourceFeature> features = new ArrayList<>();
        for (int index = 0; index < shapes.size(); index++) {
            if (rows.get(index) == null) {
                notes.add("feature " + (index + 1) + " is marked as deleted in the attribute table: left out");
                continue;
            }
            ShapefileReader.Shape shape = shapes.get(index);
            features.add(new SourceFeature(index + 1, null, rows.get(index), shape.outline(), shape.fault()));
        }
        Optional<Path> prj = sibling(".prj");
        return new FieldLayer(prj.isPresent() ? text(prj.get()) : null, features, notes);
    }

    /** Returns one row per shape; null if it is deleted. */
    private List<ObjectNode> rows(int shapes) throws InvalidFileException {
        List<ObjectNode> rows = new ArrayList<>();
        Optional<Path> dbf = sibling(".dbf");
        if (dbf.isEmpty()) {
            notes.add("there is no .dbf file next to it: the fields have no attributes");
            for (int shape = 0; shape < shapes; shape++) {
                rows.add(NgsiJson.object());
            }
            return rows;
        }
        byte[] table = bytes(dbf.get());
        Charset charset = charset(table);
        try (DBFReader reader = new DBFReader(new ByteArrayInputStream(table), charset, true)) {
            for (Object[] row = reader.nextRecord(); row != null; row = reader.nextRecord()) {
                rows.add(Boolean.TRUE.equals(row[0]) ? null : attributes(reader, row));
            }
        } catch (DBFException | NegativeArraySizeException e) { // the latter for a column of negative length
            throw new InvalidFileException(dbf.get() + " cannot be read (" + FailureText.of(e) + ")", e);
        }
        return rows;
    }

    private static ObjectNode attributes(DBFReader table, Object[] row) {
        ObjectNode attributes = NgsiJson.object();
        for (int column = 1; column < row.length; column++) {
            String name = table.getField(column).getName();
            Object value = row[column];
            if (value instanceof BigDecimal number) {
                attributes.put(name, number);
            } else if (value instanceof Number number) {
                attributes.put(name, number.doubleValue());
            } else if (value instanceof Boolean truth) {
                attributes.put(name, truth);
            } else if (value instanceof Date date) {
                attributes.put(
                        name,
                        date.toInstant()
                                .atZone(ZoneId.systemDefault())
                                .toLocalDate()
                                .toString());
            } else if (value != null && !value.toString().isBlank()) {
                attributes.put(name, value.toString().strip());
            }
        }
        return attributes;
    }

    /** Returns the code page that .cpg names, else the one that the table names, else the detected one. */
    private Charset charset(byte[] table) throws InvalidFileException {
        Optional<Path> cpg = sibling(".cpg");
        String named = cpg.isPresent() ? text(cpg.get()) : "";
        if (!named.isEmpty()) {
            return CodePage.named(named)
                    .orElseThrow(() -> new InvalidFileException(
                            "%s names the unknown code page '%s'; write the encoding of the .dbf file into it, for instance UTF-8 or 1252"
                                    .formatted(cpg.get(), named)));
        }
        Optional<Charset> own = CodePage.of(table);
        CodePage.Texts texts = CodePage.isDefault(table) ? CodePage.textsOf(table) : CodePage.Texts.ASCII;
        Charset assumed =
                texts == CodePage.Texts.UTF_8 ? StandardCharsets.UTF_8 : own.orElse(StandardCharsets.ISO_8859_1);
        if (texts != CodePage.Texts.ASCII && !own.equals(Optional.of(assumed))) {
            notes.add("there is no .cpg file next to it: its texts were read as " + assumed.name());
        }
        return assumed;
    }

    /** Reads a file without byte order mark and surrounding blanks. */
    private static String text(Path file) throws InvalidFileException {
        byte[] bytes = bytes(file);
        int begin = GeoJsonFields.begin(bytes);
        return new String(bytes, begin, bytes.length - begin, StandardCharsets.UTF_8)
                .replace('\0', ' ')
                .strip();
    }

    private static byte[] bytes(Path file) throws InvalidFileException {
        try {
            return Files.readAllBytes(file);
        } catch (IOException e) {
            throw new InvalidFileException(file, e);
        }
    }

    /** Finds the file of the same name with another extension, in lower or upper case. */
    private Optional<Path> sibling(String ending) {
        String name = shp.getFileName().toString().replaceFirst("\\.[^.]*$", "");
        return Stream.of(ending, ending.toUpperCase(Locale.ROOT))
                .map(one -> shp.resolveSibling(name + one))
                .filter(Files::isRegularFile)
                .findFirst();
    }
}
