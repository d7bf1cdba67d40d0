package io.furrow.http.flink;

import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.util.ArrayDeque;
import java.util.Deque;
import java.util.Map;
import java.util.regex.Pattern;

import org.apache.flink.runtime.rest.messages.ErrorResponseBody;
import org.apache.flink.runtime.rest.util.RestMapperUtils;
import org.apache.flink.shaded.jackson2.com.fasterxml.jackson.core.JsonProcessingException;
import org.apache.flink.shaded.netty4.io.netty.buffer.Unpooled;
import org.apache.flink.shaded.netty4.io.netty.channel.ChannelDuplexHandler;
import org.apache.flink.shaded.netty4.io.netty.channel.ChannelFutureListener;
import org.apache.flink.shaded.netty4.io.netty.channel.ChannelHandlerContext;
import org.apache.flink.shaded.netty4.io.netty.channel.ChannelPromise;
import org.apache.flink.shaded.netty4.io.netty.handler.codec.http.DefaultFullHttpResponse;
import org.apache.flink.shaded.netty4.io.netty.handler.codec.http.FullHttpResponse;
import org.apache.flink.shaded.netty4.io.netty.handler.codec.http.HttpHeaderNames;
import org.apache.flink.shaded.netty4.io.netty.handler.codec.http.HttpHeaderValues;
import org.apache.flink.shaded.netty4.io.netty.handler.codec.http.HttpMethod;
import org.apache.flink.shaded.netty4.io.netty.handler.codec.http.HttpRequest;
import org.apache.flink.shaded.netty4.io.netty.handler.codec.http.HttpResponse;
import org.apache.flink.shaded.netty4.io.netty.handler.codec.http.HttpResponseStatus;
import org.apache.flink.shaded.netty4.io.netty.handler.codec.http.HttpServerCodec;
import org.apache.flink.shaded.netty4.io.netty.handler.codec.http.HttpUtil;
import org.apache.flink.shaded.netty4.io.netty.handler.codec.http.HttpVersion;
import org.apache.flink.shaded.netty4.io.netty.handler.codec.http.LastHttpContent;
import org.apache.flink.shaded.netty4.io.netty.handler.ssl.SslHandler;
import org.apache.flink.shaded.netty4.io.netty.util.ReferenceCountUtil;

import io.furrow.http.AccessRule;
import io.furrow.http.Decision;
import io.furrow.http.HttpCall;

/**
 * Decides on the requests of one connection. Flink adds handlers of its service interface behind the one that writes
 * uploads to disk and the one that buffers bodies of up to 100 MB, so this one moves to the front.
 */
final class AccessChannelHandler extends ChannelDuplexHandler {
    private static final String IN_FRONT = "furrow-access";
    /**
     * A body up to this size is read before the answer, because a client that is still sending may lose an answer when
     * the connection closes.
     */
    private static final int MAX_DRAINED = 64 * 1024;
    /** Paths that end a job although their method is GET; Flink has them for YARN's proxy. */
    private static final Pattern COMMAND_BY_GET = Pattern.compile(".*/yarn-(cancel|stop)/?");

    private final AccessRule rule;
    private final boolean readOnly;
    /** Headers of the pending answers, in the order of their requests. */
    private final Deque<Map<String, String>> granted = new ArrayDeque<>();
    /** The answer to a rejected request; the connection is closed behind it. */
    private FullHttpResponse closing;

    private boolean closed;

    AccessChannelHandler(AccessRule rule, boolean readOnly) {
        this.rule = rule;
        this.readOnly = readOnly;
    }

    @Override
    public void handlerAdded(ChannelHandlerContext context) {
        ChannelHandlerContext codec = context.pipeline().context(HttpServerCodec.class);
        if (codec != null && !context.name().equals(IN_FRONT)) {
            context.pipeline().remove(this);
            context.pipeline().addAfter(codec.name(), IN_FRONT, new AccessChannelHandler(rule, readOnly));
        }
    }

    @Override
    public void channelRead(ChannelHandlerContext context, Object message) {
        if (closing != null) {
            boolean last = message instanceof LastHttpContent;
            ReferenceCountUtil.release(message);
            if (last) {
                close(context);
            }
        } else if (message instanceof HttpRequest request) {
            decide(context, request);
        } else {
            context.fireChannelRead(message);
        }
    }

    private void decide(ChannelHandlerContext context, HttpRequest request) {
        Decision decision = rule.decide(call(context, request));
        if (decision instanceof Decision.Granted grant && !(readOnly && isCommand(request))) {
            granted.add(grant.headers());
            context.fireChannelRead(request);
            return;
        }
        closing = answer(decision);
        ReferenceCountUtil.release(request);
        if (HttpUtil.isTransferEncodingChunked(request) || HttpUtil.getContentLength(request, 0L) > MAX_DRAINED) {
            close(context);
        }
    }

    private static boolean isCommand(HttpRequest request) {
        HttpMethod method = request.method();
        boolean reads =
                method.equals(HttpMethod.GET) || method.equals(HttpMethod.HEAD) || method.equals(HttpMethod.OPTIONS);
        String path = request.uri().split("[?#]", 2)[0];
        return !reads || COMMAND_BY_GET.matcher(path).matches();
    }

    private static FullHttpResponse answer(Decision decision) {
        if (decision instanceof Decision.Preflight preflight) {
            FullHttpResponse answer = new DefaultFullHttpResponse(HttpVersion.HTTP_1_1, HttpResponseStatus.NO_CONTENT);
            preflight.headers().forEach(answer.headers()::set);
            return answer;
        }
        String reason = decision instanceof Decision.Refused refused
                ? refused.reason()
                : "this cluster's REST API only shows (%s); who runs the cluster starts and stops its jobs"
                        .formatted(AccessOptions.READ_ONLY.key());
        FullHttpResponse answer = new DefaultFullHttpResponse(
                HttpVersion.HTTP_1_1,
                HttpResponseStatus.valueOf(Decision.REFUSED_STATUS),
                Unpooled.wrappedBuffer(json(new ErrorResponseBody(reason))));
        answer.headers().set(HttpHeaderNames.CONTENT_TYPE, HttpHeaderValues.APPLICATION_JSON);
        HttpUtil.setContentLength(answer, answer.content().readableBytes());
        return answer;
    }

    private static byte[] json(ErrorResponseBody body) {
        try {
            return RestMapperUtils.getStrictObjectMapper().writeValueAsBytes(body);
        } catch (JsonProcessingException e) {
            throw new IllegalStateException("cannot write an error as JSON", e);
        }
    }

    private void close(ChannelHandlerContext context) {
        if (!closed) {
            closed = true;
            closing.headers().set(HttpHeaderNames.CONNECTION, HttpHeaderValues.CLOSE);
            context.writeAndFlush(closing).addListener(ChannelFutureListener.CLOSE);
        }
    }

    /** Replaces the header of {@code web.access-control-allow-origin}, which allows every page. */
    @Override
    public void write(ChannelHandlerContext context, Object message, ChannelPromise promise) {
        if (message instanceof HttpResponse response && response.status().code() >= HttpResponseStatus.OK.code()) {
            response.headers().remove(HttpHeaderNames.ACCESS_CONTROL_ALLOW_ORIGIN);
            Map<String, String> headers = granted.poll();
            if (headers != null) {
                headers.forEach(response.headers()::set);
            }
        }
        context.write(message, promise);
    }

    private static HttpCall call(ChannelHandlerContext context, HttpRequest request) {
        InetAddress local =
                context.channel().localAddress() instanceof InetSocketAddress address ? address.getAddress() : null;
        return new HttpCall(
                request.method().name(),
                request.uri(),
                context.pipeline().get(SslHandler.class) != null,
                local,
                request.headers()::getAll);
    }
}
