package io.furrow.connect.sink;

import java.io.IOException;
import java.net.URI;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.concurrent.atomic.AtomicInteger;
import java.util.function.Function;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.eclipse.jetty.http.HttpField;
import org.eclipse.jetty.io.Content;
import org.eclipse.jetty.server.Handler;
import org.eclipse.jetty.server.Request;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.server.Server;
import org.eclipse.jetty.server.ServerConnector;
import org.eclipse.jetty.util.Callback;
import org.eclipse.jetty.util.component.LifeCycle;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * A context broker over real HTTP that keeps the last value of each attribute, by id: batch updates, queries and deletions of
 * NGSI-v2 and NGSI-LD. Writes are answered as a test says; those answered below 300 are done. So are queries, if it says.
 */
final class FakeContextBroker implements AutoCloseable {
    /** One write as it came in. */
    record Update(String method, String path, Map<String, String> headers, JsonNode body) {
        String service() {
            return headers.get("fiware-service");
        }

        String servicePath() {
            return headers.get("fiware-servicepath");
        }

        JsonNode elements() {
            return body.isArray() ? body : body.path("entities");
        }

        int size() {
            return elements().size();
        }
    }

    /** Status, text, and a Retry-After or null. */
    record Reply(int status, String text, String retryAfter) {
        static final Reply WRITTEN = new Reply(204, "");

        Reply(int status, String text) {
            this(status, text, null);
        }
    }

    final List<Update> requests = new CopyOnWriteArrayList<>();
    final Map<String, JsonNode> entities = new ConcurrentHashMap<>();
    final AtomicInteger queries = new AtomicInteger();
    volatile Function<Update, Reply> behaviour = request -> Reply.WRITTEN;
    /** Null for what is there. */
    volatile Reply toQueries;

    private final Server server = new Server();
    private final ServerConnector connector = new ServerConnector(server);

    FakeContextBroker() {
        connector.setHost("127.0.0.1");
        server.addConnector(connector);
        server.setHandler(new Handler.Abstract() {
            @Override
            public boolean handle(Request request, Response response, Callback callback) throws IOException {
                Reply reply = take(request);
                response.setStatus(reply.status());
                if (reply.retryAfter() != null) {
                    response.getHeaders().put("Retry-After", reply.retryAfter());
                }
                Content.Sink.write(response, true, reply.text(), callback);
                return true;
            }
        });
        LifeCycle.start(server);
    }

    URI url() {
        return URI.create("http://127.0.0.1:" + connector.getLocalPort());
    }

    /** The value of an attribute, or a missing node. */
    JsonNode value(String id, String attribute) {
        JsonNode entity = entities.get(id);
        return entity == null
                ? NgsiJson.mapper().missingNode()
                : entity.path(attribute).path("value");
    }

    private Reply take(Request request) throws IOException {
        String body = Content.Source.asString(request, UTF_8);
        String path = request.getHttpURI().getPathQuery();
        try {
            JsonNode json = body.isEmpty() ? NgsiJson.mapper().missingNode() : NgsiJson.read(body.getBytes(UTF_8));
            if (path.startsWith("/v2/op/query")) {
                queries.incrementAndGet();
                return found(json.path("entities").findValuesAsText("id"));
            } else if (request.getMethod().equals("GET")) {
                queries.incrementAndGet();
                return found(List.of(
                        Request.extractQueryParameters(request).getValue("id").split(",")));
            }
            Map<String, String> headers = new ConcurrentHashMap<>();
            for (HttpField field : request.getHeaders()) {
                headers.put(field.getLowerCaseName(), field.getValue());
            }
            Update update = new Update(request.getMethod(), path, headers, json);
            requests.add(update);
            Reply reply = behaviour.apply(update);
            return reply.status() < 300 ? done(update, reply) : reply;
        } catch (UnreadableException e) {
            return new Reply(400, e.getMessage());
        }
    }

    private Reply found(List<String> ids) {
        if (toQueries != null) {
            return toQueries;
        }
        ArrayNode found = JsonNodeFactory.instance.arrayNode();
        ids.stream().distinct().filter(entities::containsKey).map(entities::get).forEach(found::add);
        return new Reply(200, found.toString());
    }

    private Reply done(Update update, Reply reply) {
        boolean isLdDeletion = update.path().endsWith("/entityOperations/delete");
        if (isLdDeletion || update.body().path("actionType").asText().equals("delete")) {
            return deleted(update, isLdDeletion, reply);
        }
        String[] pathAndType = update.path().split("[?]type=");
        String[] attribute = pathAndType[0].split("/attrs/");
        if (update.method().equals("DELETE") && attribute.length == 2) {
            String id =
                    attribute[0].substring(attribute[0].lastIndexOf('/') + 1).replace("%3A", ":");
            boolean isThere = entities.containsKey(id) && ((ObjectNode) entities.get(id)).remove(attribute[1]) != null;
            return isThere ? reply : new Reply(404, "{\"error\":\"NotFound\"}");
        }
        if (update.method().equals("DELETE")) {
            String id = pathAndType[0].substring(pathAndType[0].lastIndexOf('/') + 1);
            return remove(id.replace("%3A", ":"), pathAndType.length == 1 ? "" : pathAndType[1])
                    ? reply
                    : new Reply(404, "{\"error\":\"NotFound\"}");
        }
        for (JsonNode entity : update.elements()) {
            String id = entity.path("id").textValue();
            if (!reply.text().contains('"' + id + '"')) {
                entities.merge(
                        id, entity, (before, after) -> ((ObjectNode) before.deepCopy()).setAll((ObjectNode) after));
            }
        }
        return reply;
    }

    /** Those that are there, and what context brokers answer where others are not. */
    private Reply deleted(Update update, boolean isLd, Reply reply) {
        List<String> absent = new ArrayList<>();
        int asked = 0;
        for (JsonNode one : update.elements()) {
            String id = isLd ? one.textValue() : one.path("id").textValue();
            asked++;
            if (!remove(id, one.path("type").asText())) {
                absent.add(id);
            }
        }
        if (absent.isEmpty()) {
            return reply;
        } else if (absent.size() == asked) {
            return new Reply(404, "{\"error\":\"NotFound\"}");
        } else if (!isLd) {
            return new Reply(422, "{\"error\": \"PartialUpdate\"}");
        }
        ObjectNode answer = JsonNodeFactory.instance.objectNode();
        absent.forEach(id -> answer.withArray("errors")
                .addObject()
                .put("entityId", id)
                .putObject("error")
                .put("status", 404));
        return new Reply(207, answer.toString());
    }

    /** @param type empty for any */
    private boolean remove(String id, String type) {
        JsonNode entity = entities.get(id);
        return entity != null
                && (type.isEmpty() || entity.path("type").asText().equals(type))
                && entities.remove(id) != null;
    }

    @Override
    public void close() {
        LifeCycle.stop(server);
    }
}
