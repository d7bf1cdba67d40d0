import java.net.InetAddress;
import java.net.InetSocketAddress;
import static java.nio.charset.StandardCharsets.UTF_8;

import com.sun.net.httpserver.HttpServer;

/** Replaces a context broker: prints each request on a line, and finds no entity. Run: java Receiver.java PORT */
class Receiver {
    public static void main(String[] arguments) throws Exception {
        InetSocketAddress address = new InetSocketAddress(InetAddress.getLoopbackAddress(), Integer.parseInt(arguments[0]));
        HttpServer server = HttpServer.create(address, 0);
        server.createContext("/", exchange -> {
            String body = new String(exchange.getRequestBody().readAllBytes(), UTF_8);
            System.out.println(exchange.getRequestMethod() + " " + exchange.getRequestURI() + " " + body);
            byte[] answer = exchange.getRequestURI().getPath().endsWith("/query") ? "[]".getBytes(UTF_8) : null;
            exchange.sendResponseHeaders(answer == null ? 204 : 200, answer == null ? -1 : answer.length);
            if (answer != null) {
                exchange.getResponseBody().write(answer);
            }
            exchange.close();
        });
        server.start();
    }
}
