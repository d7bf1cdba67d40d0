package io.furrow.model.ngsi;

/** What a topic or a store holds as JSON of its members. */
public interface StateRecord {
    /** UTF-8 JSON; members without a value are left out. */
    default byte[] toBytes() {
        return StateJson.write(this);
    }
}
