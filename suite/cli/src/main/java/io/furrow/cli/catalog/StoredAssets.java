package io.furrow.cli.catalog;

import java.io.IOException;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.mongodb.MongoException;
import org.apache.flink.core.fs.Path;

import io.furrow.mission.archive.StoredMissions;
import io.furrow.mission.image.ImageUsage;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;

/** Inspects what is stored at this moment, in MongoDB and in the image folder. */
public final class StoredAssets {
    private StoredAssets() {}

    /**
     * A line for each mission: {@code mission}, {@code collection}, {@code documents}, {@code bytes} (−1 if unknown),
     * {@code first}, {@code last}, {@code indexes}, {@code retentionSeconds} if the server removes documents.
     *
     * @throws IOException if MongoDB does not answer; the message says what to do
     */
    public static List<JsonNode> missions(String uri) throws IOException {
        List<JsonNode> lines = new ArrayList<>();
        try (StoredMissions missions = StoredMissions.open(uri)) {
            for (StoredMissions.Summary mission : missions.all()) {
                ObjectNode line = NgsiJson.mapper()
                        .createObjectNode()
                        .put("mission", mission.mission())
                        .put("collection", mission.collection())
                        .put("documents", mission.events())
                        .put("bytes", mission.bytes())
                        .put("first", mission.first().toString())
                        .put("last", mission.last().toString());
                mission.indexes().forEach(line.putArray("indexes")::add);
                if (mission.retention() != null) {
                    line.put("retentionSeconds", mission.retention().toSeconds());
                }
                lines.add(line);
            }
            return lines;
        } catch (MongoException | IllegalArgumentException e) {
            throw new IOException(
                    "MongoDB at %s: %s. Check that it runs, and --mongo."
                            .formatted(new MongoAccess(uri, null), FailureText.of(e)),
                    e);
        }
    }

    /**
     * A line for each domain and mission: {@code domain}, {@code mission}, {@code entities}, {@code images}, {@code bytes}.
     *
     * @throws IOException if the folder cannot be read
     */
    public static List<JsonNode> images(String root) throws IOException {
        List<JsonNode> lines = new ArrayList<>();
        for (ImageUsage usage : ImageUsage.of(new Path(root))) {
            lines.add(NgsiJson.mapper()
                    .createObjectNode()
                    .put("domain", usage.domain())
                    .put("mission", usage.mission())
                    .put("entities", usage.entities())
                    .put("images", usage.images())
                    .put("bytes", usage.bytes()));
        }
        return lines;
    }
}
