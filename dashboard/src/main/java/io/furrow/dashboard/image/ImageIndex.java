package io.furrow.dashboard.image;

import java.net.URI;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.errors.WakeupException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.BoundedMap;
import io.furrow.kafka.CommittedReader;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Indexes the images that {@code data.images} names by their SHA-256; at most the newest {@value #MAX}. A thread reads
 * the topic from the first request on.
 */
public final class ImageIndex implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(ImageIndex.class);
    private static final int MAX = 100_000;
    private static final Duration POLL = Duration.ofMillis(500);
    private static final Duration RETRY = Duration.ofSeconds(2);
    private static final Pattern SHA256 = Pattern.compile("[0-9a-f]{64}");
    private static final Pattern IMAGE_TYPE = Pattern.compile("image/(png|jpeg|webp|gif|avif|bmp)");

    private final Properties client;
    private final Map<String, ImageLocation> images = BoundedMap.byInsertion(MAX);
    private Thread reader;
    private CommittedReader<byte[]> topic;
    private boolean caughtUp;
    private boolean closed;

    public ImageIndex(Properties client) {
        this.client = client;
    }

    /**
     * Waits until the topic was read to its end, at most for the timeout.
     *
     * @return empty if the topic does not name the image
     */
    Optional<ImageLocation> find(String sha256, Duration timeout) throws InterruptedException {
        if (!SHA256.matcher(sha256).matches()) {
            return Optional.empty();
        }
        long end = System.nanoTime() + timeout.toNanos();
        synchronized (images) {
            startReading();
            while (!images.containsKey(sha256) && !caughtUp && System.nanoTime() < end) {
                images.wait(Math.max(1, (end - System.nanoTime()) / 1_000_000));
            }
            return Optional.ofNullable(images.get(sha256));
        }
    }

    private void startReading() {
        if (reader == null && !closed) {
            reader = new Thread(this::run, "dashboard-images");
            reader.setDaemon(true);
            reader.start();
        }
    }

    private void run() {
        while (!isClosed()) {
            try {
                readTopic();
            } catch (WakeupException e) {
                return; // closed
            } catch (KafkaException e) {
                LOG.warn("{} cannot be read; next attempt in {}", Topics.IMAGES, RETRY, e);
                pause();
            }
        }
    }

    private void readTopic() {
        try (CommittedReader<byte[]> opened = CommittedReader.openBytes(client, Topics.IMAGES)) {
            synchronized (images) {
                if (closed) {
                    return;
                }
                topic = opened;
            }
            while (!isClosed()) {
                boolean exists = opened.isAssigned(Topics.IMAGES) || opened.assign(List.of(Topics.IMAGES));
                if (exists) {
                    opened.poll(POLL).forEach(record -> index(record.value()));
                }
                if (opened.isCaughtUp()) {
                    synchronized (images) {
                        caughtUp = true;
                        images.notifyAll();
                    }
                }
                if (!exists) {
                    pause();
                }
            }
        } finally {
            synchronized (images) {
                topic = null;
            }
        }
    }

    /** Ignores records that are invalid or do not name an image of a supported type. */
    private void index(byte[] value) {
        if (value == null) {
            return;
        }
        try {
            JsonNode image = NgsiJson.read(value);
            String sha256 = image.path("sha256").asText();
            String contentType = image.path("contentType").asText();
            if (SHA256.matcher(sha256).matches()
                    && IMAGE_TYPE.matcher(contentType).matches()) {
                ImageLocation location =
                        new ImageLocation(sha256, URI.create(image.path("url").asText()), contentType);
                synchronized (images) {
                    images.remove(sha256);
                    images.put(sha256, location);
                    images.notifyAll();
                }
            }
        } catch (UnreadableException | IllegalArgumentException e) {
            LOG.debug("a record of {} names no image", Topics.IMAGES, e);
        }
    }

    private boolean isClosed() {
        synchronized (images) {
            return closed;
        }
    }

    private void pause() {
        synchronized (images) {
            try {
                if (!closed) {
                    images.wait(RETRY.toMillis());
                }
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
                closed = true;
            }
        }
    }

    @Override
    public void close() {
        synchronized (images) {
            closed = true;
            images.notifyAll();
            if (topic != null) {
                topic.wakeup();
            }
        }
    }
}
