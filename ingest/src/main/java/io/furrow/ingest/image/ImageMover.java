package io.furrow.ingest.image;

import java.io.IOException;
import java.time.Instant;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.node.NullNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.route.ReportedEvent;
import io.furrow.mission.image.ImageName;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Stores the images of one event and creates the event to forward. An image is replaced by
 * {@code {url, sha256, bytes, contentType}}; a broken one by null, and a header {@value #BROKEN} with the reason.
 */
final class ImageMover {
    /** Header of an event that lost an image: the reason code. */
    static final String BROKEN = "image-broken";
    /** Header {@code ce_type} of the manifest. */
    static final String TYPE_STORED = "furrow.image.stored";

    private static final String STAGE = "ingest-images";
    private static final byte[] NULL = NgsiJson.write(NullNode.getInstance());

    private final ImageSettings settings;
    private final ImageStore store;
    private final List<byte[]> quotedNames;

    ImageMover(ImageSettings settings, ImageStore store) {
        this.settings = settings;
        this.store = store;
        this.quotedNames = ImageRange.quoted(settings.attributes());
    }

    /** False if a quick check shows that the event has no image. */
    boolean concerns(TopicRecord record) {
        return record.value() != null && ImageRange.possible(record.value(), quotedNames);
    }

    /**
     * If another instance writes images, it also announces them and emits dead letters for broken ones.
     *
     * @throws IOException if the store does not accept an image; the call may be retried
     */
    MoveResult move(ReportedEvent event) throws IOException {
        MoveResult moveResult = moved(event);
        return settings.storageMode() == StorageMode.BY_OTHERS
                ? MoveResult.unannounced(moveResult.record())
                : moveResult;
    }

    private MoveResult moved(ReportedEvent event) throws IOException {
        TopicRecord record = event.record();
        List<ImageRange> spans;
        try {
            spans = ImageRange.find(record.value(), settings.attributes());
            if (spans.isEmpty()) {
                return MoveResult.unannounced(record);
            }
        } catch (UnreadableException e) {
            return new MoveResult(record, List.of(), List.of(DeadLetters.of(record, e, STAGE)), e.reason(), 0);
        }
        ImageName name =
                ImageName.of(scope(record), event.domain(), event.mission(), event.entityId(), record.timestamp());
        List<byte[]> values = new ArrayList<>();
        List<TopicRecord> manifest = new ArrayList<>();
        UnreadableException broken = null;
        long bytes = 0;
        for (ImageRange span : spans) {
            try {
                Image image = Image.of(span.text(record.value()), settings.maxBytes());
                StoredImage stored = store.store(name, image);
                values.add(NgsiJson.write(stored.json()));
                bytes += stored.bytes();
                manifest.add(manifest(event, span.attribute(), stored));
            } catch (UnreadableException e) {
                values.add(NULL);
                broken = broken == null ? e : broken;
            }
        }
        TopicRecord moved = record.withValue(ImageRange.replace(record.value(), spans, values));
        return broken == null
                ? new MoveResult(moved, manifest, List.of(), null, bytes)
                : new MoveResult(
                        moved.with(BROKEN, broken.reason().code()),
                        manifest,
                        List.of(DeadLetters.of(record, broken, STAGE)),
                        broken.reason(),
                        bytes);
    }

    private static FiwareScope scope(TopicRecord record) {
        Map<String, String> headers = record.headers();
        return FiwareScope.of(headers);
    }

    private static TopicRecord manifest(ReportedEvent event, String attribute, StoredImage stored) {
        TopicRecord record = event.record();
        ObjectNode json = NgsiJson.mapper()
                .createObjectNode()
                .put("entity", event.entityId())
                .put("type", event.type())
                .put("attribute", attribute)
                .put("domain", event.domain())
                .put("mission", event.mission())
                .put("time", Instant.ofEpochMilli(record.timestamp()).toString());
        json.setAll(stored.json());
        Map<String, String> headers = new HashMap<>(record.headers());
        headers.put(HeaderNames.CE_TYPE, TYPE_STORED);
        return TopicRecord.of(Topics.IMAGES, record.timestamp(), event.entityId(), NgsiJson.write(json), headers);
    }
}
