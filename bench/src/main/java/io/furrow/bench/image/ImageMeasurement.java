package io.furrow.bench.image;

import java.awt.image.BufferedImage;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Base64;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import javax.imageio.ImageIO;
import javax.imageio.stream.MemoryCacheImageOutputStream;

import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeinfo.Types;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.streaming.api.datastream.KeyedStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.functions.sink.v2.DiscardingSink;

import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.image.ImageOptions;
import io.furrow.ingest.image.ImageStage;
import io.furrow.ingest.image.StorageMode;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.ngsi.Entity;

/** Measures images per second of the ingest stage that stores them, beside a bare loop that decodes and writes them. */
final class ImageMeasurement {
    private static final int DIFFERENT = 16;
    private static final int CAMERAS = 50;
    private static final long TIME = 1_700_000_000_000L;

    private final int images;
    private final List<byte[]> pictures = new ArrayList<>();
    private final List<byte[]> events = new ArrayList<>();

    /** @param bytes of an image, approximately */
    ImageMeasurement(int images, int bytes) throws IOException {
        this.images = images;
        for (int i = 0; i < DIFFERENT; i++) {
            pictures.add(jpegOf(bytes, i));
            events.add(Entity.builder("camera", "Camera")
                    .text(
                            "Image",
                            Base64.getEncoder().encodeToString(pictures.get(i)).replace("=", "%3D"))
                    .build()
                    .toBytes());
        }
    }

    /** Bytes of an image. */
    int bytes() {
        return pictures.get(0).length;
    }

    /** Images a second of the bare loop: base64 to bytes, bytes to a file. */
    double bareLoop(Path folder) throws IOException {
        List<byte[]> texts = pictures.stream().map(Base64.getEncoder()::encode).toList();
        for (int camera = 0; camera < CAMERAS; camera++) {
            Files.createDirectories(folder.resolve("camera-" + camera));
        }
        long start = System.nanoTime();
        for (int i = 0; i < images; i++) {
            byte[] image = Base64.getDecoder().decode(texts.get(i % DIFFERENT));
            Files.write(folder.resolve("camera-" + i % CAMERAS).resolve(i + ".jpg"), image);
        }
        return images * 1e9 / (System.nanoTime() - start);
    }

    /** Images a second of the job's stage: found, decoded, checked, hashed, stored, replaced, in order per camera. */
    double stage(ImageOptions options, int parallelism) throws Exception {
        Configuration settings = new Configuration();
        settings.set(PipelineOptions.OBJECT_REUSE, true);
        settings.set(PipelineOptions.GENERIC_TYPES, false);
        StreamExecutionEnvironment env = StreamExecutionEnvironment.createLocalEnvironment(parallelism, settings);
        List<byte[]> values = new ArrayList<>(events);
        KeyedStream<ReportedEvent, String> cameras = env.fromSequence(0, images - 1)
                .map(i -> event(i, values.get((int) (i % DIFFERENT))))
                .returns(TypeInformation.of(ReportedEvent.class))
                .keyBy(ReportedEvent::identity, Types.STRING);
        ImageStage.move(cameras, options, StorageMode.ALL).sinkTo(new DiscardingSink<>());
        long millis = env.execute("images").getNetRuntime(); // without the start of the cluster
        return images * 1e3 / millis;
    }

    private static ReportedEvent event(long i, byte[] value) {
        String camera = "camera-" + i % CAMERAS;
        TopicRecord record = new TopicRecord(
                "data.raw",
                0,
                i,
                TIME + i,
                camera.getBytes(StandardCharsets.UTF_8),
                value,
                new HashMap<>(Map.of("ce_id", Long.toString(i))));
        return new ReportedEvent(Long.toString(i), "|/|" + camera, camera, "Camera", "bench", "images", record);
    }

    /** A JPEG of noise, whose size grows with its pixels. */
    private static byte[] jpegOf(int bytes, int seed) throws IOException {
        int side = Math.max(8, (int) Math.sqrt(bytes * 1.6));
        BufferedImage noise = new BufferedImage(side, side, BufferedImage.TYPE_INT_RGB);
        Random random = new Random(seed);
        for (int i = 0; i < side * side; i++) {
            noise.setRGB(i % side, i / side, random.nextInt(1 << 24));
        }
        ByteArrayOutputStream jpeg = new ByteArrayOutputStream();
        try (MemoryCacheImageOutputStream out = new MemoryCacheImageOutputStream(jpeg)) {
            ImageIO.write(noise, "jpg", out);
        }
        return jpeg.toByteArray();
    }
}
