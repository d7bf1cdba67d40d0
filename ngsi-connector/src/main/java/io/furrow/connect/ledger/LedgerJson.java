package io.furrow.connect.ledger;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** The ledger as one JSON object: every counter, every gauge and every detail under its name. */
public final class LedgerJson {
    private LedgerJson() {}

    /** The numbers of now. */
    public static ObjectNode of(Ledger ledger) {
        ObjectNode json = JsonNodeFactory.instance.objectNode();
        ledger.counters().forEach(counter -> json.put(counter.name(), counter.sum()));
        ledger.gauges().forEach(gauge -> json.put(gauge.name(), gauge.now().getAsLong()));
        ledger.details().forEach((name, detail) -> json.set(name, detail.get()));
        return json;
    }
}
