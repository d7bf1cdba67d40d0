package io.furrow.stores;

import java.io.IOException;
import java.util.ArrayList;
import java.util.Base64;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

import org.apache.flink.core.fs.FSDataInputStream;
import org.apache.flink.core.fs.FileStatus;
import org.apache.flink.core.fs.FileSystem;
import org.apache.flink.core.fs.Path;
import org.apache.flink.streaming.api.datastream.KeyedStream;
import org.apache.flink.streaming.api.datastream.SingleOutputStreamOperator;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;

import io.furrow.files.RandomPicture;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.image.ImageOptions;
import io.furrow.ingest.image.ImageStage;
import io.furrow.ingest.image.StorageMode;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.ngsi.Entity;

import static java.nio.charset.StandardCharsets.UTF_8;

/** The stage that moves images, run on a few cameras; and what it left in the store. */
final class StoredByJob {
    static final int IMAGES = 24;

    private static final long TIME = 1_700_000_000_000L;

    @Command(name = "images")
    private static final class Options {
        @Mixin
        private final ImageOptions images = new ImageOptions();
    }

    private StoredByJob() {}

    /** The values that the events carry afterwards, in the order of each camera: the url, and what the image was. */
    static Map<String, byte[]> run(String root) throws Exception {
        Options options = new Options();
        JobCommandLine.of(options).parseArgs("--images", root);
        Map<Long, byte[]> sent = new HashMap<>();
        List<ReportedEvent> events = new ArrayList<>();
        for (int i = 0; i < IMAGES; i++) {
            sent.put(TIME + i, RandomPicture.of(i % 2 == 0 ? "png" : "jpg", i));
            events.add(camera("urn:ngsi-ld:Camera:" + i % 4, TIME + i, sent.get(TIME + i)));
        }
        StreamExecutionEnvironment env = StreamExecutionEnvironment.getExecutionEnvironment();
        env.setParallelism(2);
        KeyedStream<ReportedEvent, String> keyed =
                env.fromData(events).setParallelism(1).keyBy(ReportedEvent::identity);
        SingleOutputStreamOperator<ReportedEvent> moved = ImageStage.move(keyed, options.images, StorageMode.ALL);
        Map<String, byte[]> stored = new TreeMap<>();
        for (ReportedEvent event : moved.executeAndCollect(2 * IMAGES)) {
            String url = Entity.parse(event.record().value())
                    .value("Image")
                    .orElseThrow()
                    .path("url")
                    .textValue();
            stored.put(url, sent.get(event.time()));
        }
        return stored;
    }

    /** Every file below a folder, with its bytes. */
    static Map<String, byte[]> files(String root) throws IOException {
        Map<String, byte[]> files = new TreeMap<>();
        collect(new Path(root), new Path(root).getFileSystem(), root, files);
        return files;
    }

    private static void collect(Path folder, FileSystem system, String root, Map<String, byte[]> files)
            throws IOException {
        for (FileStatus one : system.listStatus(folder)) {
            if (one.isDir()) {
                collect(one.getPath(), system, root, files);
            } else {
                try (FSDataInputStream in = system.open(one.getPath())) {
                    String path = one.getPath().getPath();
                    files.put(root + path.substring(path.indexOf("/north/")), in.readAllBytes());
                }
            }
        }
    }

    private static ReportedEvent camera(String id, long time, byte[] image) {
        Entity entity = Entity.builder(id, "Camera")
                .text("Image", Base64.getEncoder().encodeToString(image))
                .build();
        TopicRecord record = new TopicRecord(
                "data.raw",
                0,
                time,
                time,
                id.getBytes(UTF_8),
                entity.toBytes(),
                new HashMap<>(Map.of("ce_id", id + time)));
        return new ReportedEvent(id + time, "|/|" + id, id, "Camera", "north", "weeding", record);
    }
}
