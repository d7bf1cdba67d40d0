package io.furrow.model.event;

/** Headers of the records on {@code data.*}: UTF-8 text, with times in epoch ms unless stated otherwise. */
public final class HeaderNames {
    /** Event id, equal for all copies of a change. */
    public static final String CE_ID = "ce_id";
    /** The producer of the record, a URI reference. */
    public static final String CE_SOURCE = "ce_source";
    /** Event time, ISO 8601 in UTC. */
    public static final String CE_TIME = "ce_time";

    public static final String CE_SPECVERSION = "ce_specversion";
    public static final String CE_TYPE = "ce_type";
    public static final String SERVICE = "fiware-service";
    public static final String SERVICE_PATH = "fiware-servicepath";
    /**
     * Type of the entity that a record without a value deletes; if it is missing, all entities of the id are deleted.
     */
    public static final String ENTITY_TYPE = "entity-type";

    /** Comma-separated names of attributes that are later than the event, as those of a later measure. */
    public static final String LATER_ATTRIBUTES = "later-attributes";

    public static final String ORIGIN = "origin";
    /** The event time. */
    public static final String TS_DEVICE = "ts-device";
    /** When the source received the event. */
    public static final String TS_SOURCE = "ts-source";
    /** When ingest emitted the event. */
    public static final String TS_INGEST = "ts-ingest";

    /** Epoch of a replay's record: 0, then one more with each restart, see {@code Epochs}. */
    public static final String REPLAY_EPOCH = "replay-epoch";
    /** Kind of a replay's record: {@code event}, {@code prime} or {@code end}. */
    public static final String REPLAY_KIND = "replay-kind";
    /** Offset of a replay's record: ms that its timestamp is ahead of the original event time. */
    public static final String REPLAY_OFFSET = "replay-offset";
    /** Name of a record's replay: {@code <mission>.<id8>}. */
    public static final String REPLAY_ID = "replay-id";
    /** Time of a replay's record: its timestamp less the offset, ISO 8601; for an event the original event time. */
    public static final String REPLAY_TIME = "replay-time";
    /** Sequence of a replay's record: from 0 in each epoch, without gaps; copies of an {@code end} share one number. */
    public static final String REPLAY_SEQUENCE = "replay-sequence";
    /** Event id of the original event of a replay's record. */
    public static final String REPLAY_CE_ID = "replay-ce_id";

    public static final String SPECVERSION = "1.0";
    public static final String TYPE_CHANGED = "ngsi.entity.changed";
    public static final String TYPE_DELETED = "ngsi.entity.deleted";

    private HeaderNames() {}
}
