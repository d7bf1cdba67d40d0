package io.furrow.launcher;

import java.net.URI;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;

/** Our one subscription to every change of every entity of a tenant, found again by its description. */
final class Subscription {
    private static final String DESCRIPTION = "Furrow: every change";

    private final RestClient rest = new RestClient();
    private final URI contextBroker;
    private final Map<String, String> scope;

    Subscription(URI contextBroker, String service) {
        this.contextBroker = contextBroker;
        this.scope = Map.of("fiware-service", service, "fiware-servicepath", "/#");
    }

    /**
     * Creates it, or points the one that is there to the given address.
     *
     * @throws SuiteNotStartedException if the context broker is away or refuses
     */
    void ensure(URI notifyUrl) {
        ObjectNode wanted = wanted(notifyUrl);
        RestClient.Answer known = rest.get(contextBroker.resolve("/v2/subscriptions?limit=1000"), scope);
        check(known, "list subscriptions");
        for (JsonNode subscription : known.body()) {
            if (DESCRIPTION.equals(subscription.path("description").asText())) {
                URI one = contextBroker.resolve(
                        "/v2/subscriptions/" + subscription.path("id").asText());
                check(rest.send("PATCH", one, scope, wanted), "change our subscription");
                return;
            }
        }
        check(rest.send("POST", contextBroker.resolve("/v2/subscriptions"), scope, wanted), "subscribe");
    }

    private static ObjectNode wanted(URI notifyUrl) {
        ObjectNode body = NgsiJson.mapper().createObjectNode().put("description", DESCRIPTION);
        body.putObject("subject").putArray("entities").addObject().put("idPattern", ".*");
        ObjectNode notification = body.putObject("notification");
        notification.putObject("http").put("url", notifyUrl.toString());
        notification.put("attrsFormat", "normalized");
        notification.putArray("attrs").add("*").add("dateModified");
        return body;
    }

    private void check(RestClient.Answer answer, String what) {
        if (!answer.isSuccess()) {
            throw new SuiteNotStartedException("The context broker at %s does not let us %s: %d %s"
                    .formatted(
                            contextBroker,
                            what,
                            answer.status(),
                            answer.body().path("description").asText()));
        }
    }
}
