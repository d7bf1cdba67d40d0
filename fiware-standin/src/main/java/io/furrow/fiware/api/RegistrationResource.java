package io.furrow.fiware.api;

import java.util.List;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;

import io.furrow.fiware.Call;
import io.furrow.fiware.NgsiError;
import io.furrow.fiware.Reply;
import io.furrow.fiware.agent.Registration;
import io.furrow.fiware.broker.ContextBroker;

/** {@code GET /v2/registrations} and {@code /v2/registrations/<id>}: only those of the IoT agent exist. */
final class RegistrationResource {
    private final ContextBroker broker;

    RegistrationResource(ContextBroker broker) {
        this.broker = broker;
    }

    Reply answer(Call call) throws NgsiError {
        if (call.path().size() > 3) {
            throw NgsiError.noService();
        }
        if (!call.method().equals("GET")) {
            throw NgsiError.unsupported("registrations by clients");
        }
        List<Registration> all = broker.registrations(call.service(), call.paths());
        if (call.path().size() == 2) {
            ArrayNode page = JsonNodeFactory.instance.arrayNode();
            all.stream()
                    .skip(EntityQuery.number(call, "offset", 0))
                    .limit(EntityQuery.limit(call))
                    .forEach(registration -> page.add(registration.json()));
            return Reply.page(call, page, all.size());
        }
        return Reply.ok(all.stream()
                .filter(registration -> registration.id().equals(call.path().get(2)))
                .findFirst()
                .orElseThrow(NgsiError::noRegistration)
                .json());
    }
}
