package io.furrow.connect.sink;

import java.util.List;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.connect.sink.EntityUpdates.Update;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;

/** Writes entities into a context broker with {@code POST /v2/op/update}, action {@code append}. */
record ContextBroker(BrokerClient client) {
    private static final String UPDATE = "/v2/op/update";

    /** Writes entities of one scope. */
    Outcome append(FiwareScope scope, List<Update> updates) {
        ObjectNode body = JsonNodeFactory.instance.objectNode().put("actionType", "append");
        ArrayNode entities = body.putArray("entities");
        updates.forEach(update -> entities.add(update.entity()));
        Outcome outcome = client.send(BrokerRequest.post(scope, UPDATE, NgsiJson.write(body)));
        return outcome instanceof Outcome.Absent absent
                ? new Outcome.WrongSetting(UPDATE + " answered " + absent.words())
                : outcome;
    }
}
