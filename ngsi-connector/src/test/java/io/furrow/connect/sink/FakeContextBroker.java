package io.furrow.connect.sink;

import java.io.IOException;
import java.net.URI;
import java.nio.charset.StandardCharsets;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CopyOnWriteArrayList;
import java.util.function.Function;

import com.fasterxml.jackson.databind.JsonNode;
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

/** Takes {@code POST /v2/op/update} over real HTTP and keeps each attribute's last value; answers as a test says. */
final class FakeContextBroker implements AutoCloseable {
    /** One update as it came in. */
    record Update(String path, String service, String servicePath, JsonNode body) {
        int size() {
            return body.path("entities").size();
        }
    }

    /** Status and text. */
    record Reply(int status, String text) {
        static final Reply WRITTEN = new Reply(204, "");
    }

    final List<Update> requests = new CopyOnWriteArrayList<>();
    final Map<String, JsonNode> entities = new ConcurrentHashMap<>();
    volatile Function<Update, Reply> behaviour = request -> Reply.WRITTEN;

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
                Content.Sink.write(response, true, reply.text(), callback);
                return true;
            }
        });
        LifeCycle.start(server);
    }

    URI url() {
        return URI.create("http://127.0.0.1:" + connector.getLocalPort());
    }

    private Reply take(Request request) throws IOException {
        String body = Content.Source.asString(request, StandardCharsets.UTF_8);
        try {
            Update update = new Update(
                    Request.getPathInContext(request),
                    header(request, "Fiware-Service"),
                    header(request, "Fiware-Servicepath"),
                    NgsiJson.read(body.getBytes(StandardCharsets.UTF_8)));
            requests.add(update);
            Reply reply = behaviour.apply(update);
            if (reply.status() < 300) {
                update.body()
                        .path("entities")
                        .forEach(entity -> entities.put(entity.path("id").textValue(), entity));
            }
            return reply;
        } catch (UnreadableException e) {
            return new Reply(400, e.getMessage());
        }
    }

    private static String header(Request request, String name) {
        HttpField field = request.getHeaders().getField(name);
        return field == null ? null : field.getValue();
    }

    @Override
    public void close() {
        LifeCycle.stop(server);
    }
}
