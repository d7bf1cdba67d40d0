package io.furrow.ingest.image;

import java.awt.image.BufferedImage;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.util.Base64;
import java.util.HashMap;
import java.util.Map;
import java.util.Random;
import javax.imageio.ImageIO;
import javax.imageio.stream.MemoryCacheImageOutputStream;

import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;

/** Images and the events of cameras for tests; the same seed, the same bytes. */
public final class Pictures {
    public static final long TIME = 1_700_000_000_123L;

    private Pictures() {}

    public static byte[] png(int seed) {
        return image("png", seed);
    }

    static byte[] jpeg(int seed) {
        return image("jpg", seed);
    }

    private static byte[] image(String format, int seed) {
        BufferedImage image = new BufferedImage(24, 16, BufferedImage.TYPE_INT_RGB);
        Random random = new Random(seed);
        for (int i = 0; i < 24 * 16; i++) {
            image.setRGB(i % 24, i / 24, random.nextInt(1 << 24));
        }
        ByteArrayOutputStream bytes = new ByteArrayOutputStream();
        try (MemoryCacheImageOutputStream out = new MemoryCacheImageOutputStream(bytes)) {
            ImageIO.write(image, format, out);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
        return bytes.toByteArray();
    }

    public static String base64(byte[] bytes) {
        return Base64.getEncoder().encodeToString(bytes);
    }

    static ReportedEvent camera(String id, long time, byte[] image) {
        return event(id, time, Entity.builder(id, "Camera").text("Image", base64(image)));
    }

    static ReportedEvent thermometer(String id, long time) {
        return event(id, time, Entity.builder(id, "Thermometer").number("Temperature", 21.5));
    }

    static ReportedEvent event(String id, long time, EntityBuilder entity) {
        return event(id, time, entity.build().toBytes());
    }

    static ReportedEvent event(String id, long time, byte[] value) {
        String eventId = id + "@" + time;
        TopicRecord record = new TopicRecord(
                "data.raw",
                0,
                7,
                time,
                id.getBytes(java.nio.charset.StandardCharsets.UTF_8),
                value,
                new HashMap<>(Map.of(HeaderNames.CE_ID, eventId, HeaderNames.SERVICE, "farm")));
        return new ReportedEvent(eventId, "farm|/|" + id, id, "Camera", "north", "weeding", record);
    }
}
