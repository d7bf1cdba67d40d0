package io.furrow.model.event;

/** Headers of the records on {@code data.*}; all values are UTF-8 text, times are epoch milliseconds unless said. */
public final class HeaderNames {
    /** Event id: equal for every copy of the same change. */
    public static final String CE_ID = "ce_id";
    /** Who made the record, a URI reference. */
    public static final String CE_SOURCE = "ce_source";
    /** Event time, ISO 8601 in UTC. */
    public static final String CE_TIME = "ce_time";

    public static final String CE_SPECVERSION = "ce_specversion";
    public static final String CE_TYPE = "ce_type";
    public static final String SERVICE = "fiware-service";
    public static final String SERVICE_PATH = "fiware-servicepath";
    /** Type of the entity that a record without a value deletes; all entities of the id end where it is missing. */
    public static final String ENTITY_TYPE = "entity-type";

    /** Names of attributes that are of a later time than the event, as of a measure that a device sends afterwards; with commas. */
    public static final String LATER_ATTRIBUTES = "later-attributes";

    public static final String ORIGIN = "origin";
    /** The event's own time. */
    public static final String TS_DEVICE = "ts-device";
    /** When the source received the event. */
    public static final String TS_SOURCE = "ts-source";
    /** When ingest passed the event on. */
    public static final String TS_INGEST = "ts-ingest";

    /** Of a replay's record: 0, then one more with each start over, see {@code Epochs}. */
    public static final String REPLAY_EPOCH = "replay-epoch";
    /** Of a replay's record: {@code event}, {@code prime} or {@code end}. */
    public static final String REPLAY_KIND = "replay-kind";
    /** Of a replay's record: ms that its timestamp is ahead of the original event time. */
    public static final String REPLAY_OFFSET = "replay-offset";
    /** Of a replay's record: {@code <mission>.<id8>}. */
    public static final String REPLAY_ID = "replay-id";
    /** Of a replay's record: its timestamp less the offset, ISO 8601; of an event the original event time. */
    public static final String REPLAY_TIME = "replay-time";
    /** Of a replay's record: from 0 in each epoch, contiguous; copies of an {@code end} have one number. */
    public static final String REPLAY_SEQUENCE = "replay-sequence";
    /** Of a replay's record: event id of the original event. */
    public static final String REPLAY_CE_ID = "replay-ce_id";

    public static final String SPECVERSION = "1.0";
    public static final String TYPE_CHANGED = "ngsi.entity.changed";
    public static final String TYPE_DELETED = "ngsi.entity.deleted";

    private HeaderNames() {}
}
