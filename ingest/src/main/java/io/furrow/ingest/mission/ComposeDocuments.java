package io.furrow.ingest.mission;

import java.nio.charset.StandardCharsets;

import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.streaming.api.functions.ProcessFunction;
import org.apache.flink.util.Collector;

import io.furrow.flink.record.DeadLetterCounters;
import io.furrow.flink.record.DeadLetters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.StoredEvent;
import io.furrow.mission.mongo.EventDocumentCodec;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/** Composes the document of each event of a mission; emits dead letters for events that no document can hold. */
public final class ComposeDocuments extends ProcessFunction<MissionEvent, MissionDocument> {
    private static final long serialVersionUID = 1L;
    /** The stage in dead letters. */
    static final String STAGE = "missions";

    private transient DeadLetterCounters dead;

    @Override
    public void open(OpenContext context) {
        dead = new DeadLetterCounters(getRuntimeContext().getMetricGroup());
    }

    @Override
    public void processElement(MissionEvent event, Context context, Collector<MissionDocument> out) {
        if (event.mission().isEmpty()) {
            return;
        }
        try {
            out.collect(compose(event));
        } catch (UnreadableException e) {
            dead.count(e.reason(), event.domain(), event.mission());
            context.output(DeadLetters.TAG, DeadLetters.of(event.record(), e, STAGE));
        }
    }

    /** @throws UnreadableException if it is not an event, or no document can hold it */
    public static MissionDocument compose(MissionEvent event) throws UnreadableException {
        TopicRecord record = event.record();
        String id = record.headers().get(HeaderNames.CE_ID);
        if (id == null) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "the record has no event id");
        }
        Entity entity = record.value() == null ? null : Entity.parse(record.value());
        byte[] bson = EventDocumentCodec.write(new StoredEvent(
                id,
                record.timestamp(),
                entity == null ? key(record) : entity.id(),
                EventDocumentCodec.storedHeaders(record.headers()),
                entity == null ? null : entity.json()));
        return new MissionDocument(MissionCollections.nameOf(event.mission()), id, bson, event);
    }

    private static String key(TopicRecord record) throws UnreadableException {
        if (record.key() == null) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "the deletion names no entity: the record has no key");
        }
        return new String(record.key(), StandardCharsets.UTF_8);
    }
}
