package io.furrow.model.ngsi;

/** A record that topics and stores contain as JSON. */
public interface StateRecord {
    /** Returns UTF-8 JSON without nulls. */
    default byte[] toBytes() {
        return StateJson.write(this);
    }
}
