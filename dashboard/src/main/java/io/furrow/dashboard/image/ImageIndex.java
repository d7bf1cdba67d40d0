package io.furrow.dashboard.image;

import java.net.URI;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.errors.WakeupException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.dashboard.http.Problem;
import io.furrow.kafka.BoundedMap;
import io.furrow.kafka.CommittedReader;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Indexes by their SHA-256 the images that the newest {@value #MAX} records of {@code data.images} name. */
public final class ImageIndex implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(ImageIndex.class);
    private static final int MAX = 100_000;
    private static final Duration POLL = Duration.ofMillis(500);
    private static final Duration RETRY = Duration.ofSeconds(2);
    private static final Duration TIMEOUT = Duration.ofSeconds(1);
    private static final int MAX_WAITING = 16;
    private static final Pattern SHA256 = Pattern.compile("[0-9a-f]{64}");
    private static final Pattern IMAGE_TYPE = Pattern.compile("image/(png|jpeg|webp|gif|avif|bmp)");

    private final Properties client;
    private final int max;
    private final Map<String, ImageLocation> images;
    private CommittedReader<byte[]> topic;
    private boolean isComplete;
    private boolean isRequested;
    private int waiting;
    private final CountDownLatch closed = new CountDownLatch(1);

    public ImageIndex(Properties client) {
        this(client, MAX);
    }

    ImageIndex(Properties client, int max) {
        this.client = client;
        this.max = max;
        this.images = BoundedMap.byInsertion(max);
    }

    /** Starts to read the topic on another thread. */
    public void start() {
        Thread reader = new Thread(this::run, "dashboard-images");
        reader.setDaemon(true);
        reader.start();
    }

    /**
     * Waits for the image at most {@code TIMEOUT}, and not at all if many wait already: the record that names it to others
     * may not have been read here.
     *
     * @return empty if none of the records names the image
     * @throws Problem 503 if they have not all been read yet, or many wait already
     */
    Optional<ImageLocation> find(String sha256) {
        if (!SHA256.matcher(sha256).matches()) {
            return Optional.empty();
        }
        synchronized (images) {
            isRequested = true;
            images.notifyAll();
            boolean hasWaited = await(sha256);
            if (!(isComplete && hasWaited) && !images.containsKey(sha256)) {
                throw new Problem(503, "images-loading", "the list of images is being read; try again in a moment");
            }
            return Optional.ofNullable(images.get(sha256));
        }
    }

    private boolean await(String sha256) {
        if (waiting >= MAX_WAITING) {
            return false;
        }
        long end = System.nanoTime() + TIMEOUT.toNanos();
        waiting++;
        try {
            long left = TIMEOUT.toMillis();
            while (!images.containsKey(sha256) && left > 0 && !isClosed()) {
                images.wait(left);
                left = (end - System.nanoTime()) / 1_000_000;
            }
            return true;
        } catch (InterruptedException e) {
            throw Problem.stopping();
        } finally {
            waiting--;
        }
    }

    private void run() {
        try {
            while (!isClosed()) {
                try {
                    readTopic();
                } catch (WakeupException e) {
                    return; // closed
                } catch (KafkaException e) {
                    LOG.warn("{} cannot be read; next attempt in {}", Topics.IMAGES, RETRY, e);
                    closed.await(RETRY.toMillis(), TimeUnit.MILLISECONDS);
                }
            }
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    private void readTopic() throws InterruptedException {
        try (CommittedReader<byte[]> opened = CommittedReader.openBytes(client, Topics.IMAGES)) {
            synchronized (images) {
                if (isClosed()) {
                    return;
                }
                topic = opened;
            }
            opened.seekToNewest(max);
            while (!isClosed()) {
                if (opened.isAssigned(Topics.IMAGES) || opened.assign(List.of(Topics.IMAGES))) {
                    opened.poll(POLL).forEach(record -> index(record.value()));
                    if (opened.isCaughtUp()) {
                        complete();
                    }
                } else {
                    awaitRequest();
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

    private void complete() {
        synchronized (images) {
            isComplete = true;
        }
    }

    /** Whoever knows the name of an image has it from the topic, which is created for the first image. */
    private void awaitRequest() throws InterruptedException {
        synchronized (images) {
            while (!isRequested && !isClosed()) {
                images.wait();
            }
            isRequested = false;
        }
    }

    private boolean isClosed() {
        return closed.getCount() == 0;
    }

    @Override
    public void close() {
        closed.countDown();
        synchronized (images) {
            images.notifyAll();
            if (topic != null) {
                topic.wakeup();
            }
        }
    }
}
