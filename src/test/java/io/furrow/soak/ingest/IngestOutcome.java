package io.furrow.soak.ingest;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.SortedMap;
import java.util.TreeMap;
import java.util.stream.Stream;

import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoDatabase;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.common.header.Header;
import org.bson.Document;

import io.furrow.files.Folders;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * All that the job wrote, as sorted lines by topic, collection and folder, for comparison with another run.
 *
 * <p>Excludes what legitimately differs between runs: {@code ts-ingest}, the wall clock at which an event was
 * processed; the folder of the images; all records of a key of {@code data.catalog} but the last, because the others
 * depend on when event time advanced; files whose names begin with {@code .unfinished-}, left by a killed process.
 * Records are numbered per key; dead letters per key and stage.
 */
public record IngestOutcome(SortedMap<String, List<String>> lines) {
    private static final String UNFINISHED = ".unfinished-";
    private static final int MAX_SHOWN = 3;

    /**
     * Arguments: bootstrap servers, URI of MongoDB, folder of the images, file for the lines; prints the number of
     * lines.
     */
    public static void main(String... args) throws IOException {
        IngestOutcome outcome = of(args[0], args[1], Path.of(args[2]));
        try (var out = Files.newBufferedWriter(Path.of(args[3]))) {
            for (Map.Entry<String, List<String>> place : outcome.lines.entrySet()) {
                for (String line : place.getValue()) {
                    out.write(place.getKey() + "\t" + line + "\n");
                }
                System.out.printf("%8d %s%n", place.getValue().size(), place.getKey());
            }
        }
        System.out.printf("%8d files left unfinished%n", unfinished(Path.of(args[2])));
    }

    static IngestOutcome of(String bootstrapServers, String mongo, Path images) throws IOException {
        String root = images.toUri().toString().replaceAll("/+$", "");
        SortedMap<String, List<String>> lines = new TreeMap<>();
        try (CommittedTopics topics = new CommittedTopics(bootstrapServers)) {
            for (String topic : topics.names()) {
                lines.put("topic " + topic, records(topics.read(topic), root));
                if (topic.equals(Topics.CATALOG)) {
                    lines.compute("topic " + topic, (name, all) -> lastOfEach(all));
                }
            }
            lines.put("transactions left open", topics.behindAnOpenTransaction());
        }
        try (MongoClient client = MongoClients.create(mongo)) {
            MongoDatabase missions = client.getDatabase("persistence");
            for (String name : missions.listCollectionNames()) {
                lines.put("collection " + name, documents(missions, name, root));
            }
        }
        lines.put("images", files(images));
        return new IngestOutcome(lines);
    }

    /** Numbers the records of each key. */
    private static List<String> records(List<ConsumerRecord<byte[], byte[]>> records, String root) {
        Map<String, Integer> numbers = new HashMap<>();
        List<String> lines = new ArrayList<>();
        for (ConsumerRecord<byte[], byte[]> record : records) {
            String key = text(record.key());
            Map<String, String> headers = new TreeMap<>();
            for (Header header : record.headers()) {
                headers.put(header.key(), text(header.value()));
            }
            headers.remove(HeaderNames.TS_INGEST);
            String ordered = key + headers.getOrDefault(DeadLetter.STAGE, "");
            lines.add("%s #%06d @%d %s %s"
                    .formatted(
                            key,
                            numbers.merge(ordered, 1, Integer::sum),
                            record.timestamp(),
                            headers,
                            text(record.value()).replace(root, "images:")));
        }
        return lines.stream().sorted().toList();
    }

    private static List<String> lastOfEach(List<String> sorted) {
        Map<String, String> last = new TreeMap<>();
        sorted.forEach(line -> last.put(line.substring(0, line.indexOf(" #")), line.replaceFirst(" #\\d+", "")));
        return List.copyOf(last.values());
    }

    private static List<String> documents(MongoDatabase missions, String name, String root) {
        List<String> lines = new ArrayList<>();
        for (Document document : missions.getCollection(name).find()) {
            document.get("_headers", Document.class).remove(HeaderNames.TS_INGEST);
            lines.add(document.toJson().replace(root, "images:"));
        }
        return lines.stream().sorted().toList();
    }

    private static List<String> files(Path folder) throws IOException {
        return Folders.walk(folder).stream()
                .filter(Files::isRegularFile)
                .filter(file -> !file.getFileName().toString().startsWith(UNFINISHED))
                .map(file -> folder.relativize(file) + " " + sha256(file))
                .toList();
    }

    static long unfinished(Path folder) throws IOException {
        return Folders.walk(folder).stream()
                .filter(file -> file.getFileName().toString().startsWith(UNFINISHED))
                .count();
    }

    private static String sha256(Path file) {
        try {
            byte[] hash = java.security.MessageDigest.getInstance("SHA-256").digest(Files.readAllBytes(file));
            return java.util.HexFormat.of().formatHex(hash);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        } catch (java.security.NoSuchAlgorithmException e) {
            throw new AssertionError("every JDK has it", e);
        }
    }

    private static String text(byte[] bytes) {
        return bytes == null ? "nothing" : new String(bytes, UTF_8);
    }

    int size(String place) {
        return lines.getOrDefault(place, List.of()).size();
    }

    /** Describes lines that are only here or only in the other outcome, with some examples. */
    List<String> differencesTo(IngestOutcome other) {
        List<String> differences = new ArrayList<>();
        for (String place : Stream.concat(lines.keySet().stream(), other.lines.keySet().stream())
                .distinct()
                .toList()) {
            List<String> here = lines.getOrDefault(place, List.of());
            List<String> there = other.lines.getOrDefault(place, List.of());
            if (!here.equals(there)) {
                differences.add(place + ": " + here.size() + " here, " + there.size() + " there");
                differences.addAll(only("here", here, there));
                differences.addAll(only("there", there, here));
            }
        }
        return differences;
    }

    private static List<String> only(String where, List<String> some, List<String> others) {
        var existing = new java.util.HashSet<>(others);
        return some.stream()
                .filter(line -> !existing.contains(line))
                .limit(MAX_SHOWN)
                .map(line -> "only " + where + ": " + line)
                .toList();
    }
}
