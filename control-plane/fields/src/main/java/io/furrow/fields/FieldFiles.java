package io.furrow.fields;

import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import io.furrow.model.field.FieldFile;
import io.furrow.model.field.ImportOptions;
import io.furrow.model.field.ImportedField;
import io.furrow.model.field.InvalidFileException;
import io.furrow.model.field.RejectedFeature;

/** Reads the fields of files: GeoJSON, Shapefiles and GeoPackages, in any coordinate system that GeoTools knows. */
public final class FieldFiles {
    private static final int FIRST_BYTES = 16;

    private FieldFiles() {}

    /** Reads GeoJSON, a Shapefile or a GeoPackage, detected by the first bytes. */
    public static FieldFile read(Path file, ImportOptions options) throws InvalidFileException {
        FieldLayer layer = layer(file, options);
        String crs = options.crs() == null ? layer.crs() : options.crs();
        if (crs == null) {
            throw new InvalidFileException(file
                    + " does not name its coordinate system; specify it with --crs, for instance --crs"
                    + " EPSG:25830");
        }
        Georeference georeference = Georeference.of(crs);
        FeatureNaming naming = FeatureNaming.of(file, layer.features(), options);
        Map<String, Integer> numberById = new HashMap<>();
        List<ImportedField> fields = new ArrayList<>();
        List<RejectedFeature> rejected = new ArrayList<>();
        for (SourceFeature feature : layer.features()) {
            try {
                String id = naming.id(feature);
                Integer earlier = numberById.putIfAbsent(id, feature.number());
                if (earlier != null) {
                    throw new RejectedFeatureException(
                            "has the id of feature " + earlier + "; give each field a unique id");
                }
                fields.add(field(feature, georeference, naming));
            } catch (RejectedFeatureException e) {
                rejected.add(new RejectedFeature(feature.number(), naming.called(feature), e.getMessage()));
            }
        }
        return new FieldFile(georeference.name(), georeference.accuracyMeters(), fields, rejected, layer.notes());
    }

    private static ImportedField field(SourceFeature feature, Georeference georeference, FeatureNaming naming)
            throws RejectedFeatureException {
        if (feature.fault() != null) {
            throw new RejectedFeatureException(feature.fault());
        }
        RepairedArea repaired = AreaRepair.repair(feature.outline(), georeference);
        return new ImportedField(
                feature.number(),
                naming.version(feature, GeoJsonArea.of(repaired.area())),
                EllipsoidArea.hectares(repaired.area()),
                repaired.notes(),
                repaired.edgeErrorMeters());
    }

    private static FieldLayer layer(Path file, ImportOptions options) throws InvalidFileException {
        byte[] first;
        try (InputStream in = Files.newInputStream(file)) {
            first = in.readNBytes(FIRST_BYTES);
        } catch (IOException e) {
            throw new InvalidFileException(file, e);
        }
        int begin = GeoJsonFields.begin(first);
        String text = new String(first, begin, first.length - begin, StandardCharsets.ISO_8859_1);
        if (text.startsWith("SQLite format 3")) {
            return GeoPackageFields.read(file, options.layer());
        }
        if (options.layer() != null) {
            throw new InvalidFileException("--layer applies to GeoPackages only; " + file + " has no layers");
        }
        if (text.startsWith("\0\0'\n")) {
            return ShapefileFields.read(file);
        }
        if (text.strip().startsWith("{")) {
            return GeoJsonFields.read(file);
        }
        throw new InvalidFileException(file
                + " is neither GeoJSON nor a Shapefile (.shp) nor a GeoPackage; unpack it first if it is an archive");
    }
}
