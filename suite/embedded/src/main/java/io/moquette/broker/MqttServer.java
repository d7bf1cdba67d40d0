package io.moquette.broker;

import java.time.Clock;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.WeakHashMap;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.Executors;
import java.util.concurrent.ScheduledExecutorService;
import java.util.concurrent.TimeUnit;
import java.util.function.Predicate;

import io.moquette.broker.config.IConfig;
import io.moquette.broker.security.IAuthenticator;
import io.moquette.broker.security.IAuthorizatorPolicy;
import io.moquette.broker.subscriptions.CTrieSubscriptionDirectory;
import io.moquette.broker.subscriptions.ISubscriptionsDirectory;
import io.moquette.broker.subscriptions.Topic;
import io.moquette.interception.BrokerInterceptor;
import io.moquette.persistence.MemorySessionsRepository;
import io.moquette.persistence.MemorySubscriptionsRepository;
import io.netty.channel.Channel;
import io.netty.channel.group.ChannelGroup;
import io.netty.channel.group.DefaultChannelGroup;
import io.netty.handler.codec.mqtt.MqttConnectMessage;
import io.netty.handler.codec.mqtt.MqttPublishMessage;
import io.netty.util.ReferenceCountUtil;
import io.netty.util.concurrent.ImmediateEventExecutor;

/**
 * Moquette in memory, assembled as by {@link Server}, but as strict as Mosquitto: a message that its sender may not publish is
 * acknowledged and discarded, where {@link Server} never answers; a will is published only if its owner may; a connection of a
 * removed user is closed within a second.
 */
public final class MqttServer implements AutoCloseable {
    private static final long SECOND = 1;

    private final ScheduledExecutorService scheduler = Executors.newScheduledThreadPool(1);
    private final ChannelGroup connections = new DefaultChannelGroup(ImmediateEventExecutor.INSTANCE);
    private final NewNettyAcceptor acceptor = new NewNettyAcceptor();
    private final BrokerInterceptor interceptor;
    private final Sessions sessions;
    private final PostOffice messages;

    /**
     * Authentication and authorization.
     *
     * @param exists whether there is a user of this name
     */
    public record Access(IAuthenticator logins, IAuthorizatorPolicy rights, Predicate<String> exists) {}

    /** Listens until it is closed. */
    public MqttServer(IConfig config, Access access) {
        interceptor = new BrokerInterceptor(config, List.of());
        Authorizator rights = new Authorizator(access.rights());
        ISubscriptionsDirectory subscriptions = new CTrieSubscriptionDirectory();
        subscriptions.init(new MemorySubscriptionsRepository());
        SessionEventLoopGroup loops =
                new SessionEventLoopGroup(interceptor, config.intProp(IConfig.SESSION_QUEUE_SIZE, 1024));
        sessions = new Sessions(subscriptions, rights, scheduler, loops);
        messages = new Messages(subscriptions, sessions, interceptor, rights, loops, access);
        BrokerConfiguration settings = new BrokerConfiguration(config);
        acceptor.initialize(
                new NewNettyMQTTHandler(new MQTTConnectionFactory(settings, access.logins(), sessions, messages) {
                    @Override
                    MQTTConnection create(Channel channel) {
                        connections.add(channel);
                        return super.create(channel);
                    }
                }),
                config,
                new DefaultMoquetteSslContextCreator(config),
                settings);
        scheduler.scheduleWithFixedDelay(() -> closeOthers(access.exists()), SECOND, SECOND, TimeUnit.SECONDS);
    }

    private void closeOthers(Predicate<String> exists) {
        connections.close(connection -> {
            String user = NettyUtils.userName(connection);
            return user != null && !exists.test(user);
        });
    }

    @Override
    public void close() {
        acceptor.close();
        scheduler.shutdownNow();
        sessions.close();
        interceptor.stop();
        messages.terminate();
    }

    /** Records the owner of each will. */
    private static final class Sessions extends SessionRegistry {
        private final Map<Session.Will, String> owners = Collections.synchronizedMap(new WeakHashMap<>());

        Sessions(
                ISubscriptionsDirectory subscriptions,
                Authorizator rights,
                ScheduledExecutorService scheduler,
                SessionEventLoopGroup loops) {
            super(
                    subscriptions,
                    new MemorySessionsRepository(),
                    new MemoryQueueRepository(),
                    rights,
                    scheduler,
                    Clock.systemDefaultZone(),
                    Session.INFINITE_EXPIRY,
                    loops);
        }

        @Override
        SessionCreationResult createOrReopenSession(MqttConnectMessage connect, String client, String user) {
            SessionCreationResult created = super.createOrReopenSession(connect, client, user);
            if (created.session.hasWill()) {
                owners.put(created.session.getWill(), user);
            }
            return created;
        }
    }

    private static final class Messages extends PostOffice {
        private final Sessions sessions;
        private final Authorizator rights;
        private final Predicate<String> exists;

        Messages(
                ISubscriptionsDirectory subscriptions,
                Sessions sessions,
                BrokerInterceptor interceptor,
                Authorizator rights,
                SessionEventLoopGroup loops,
                Access access) {
            super(subscriptions, new MemoryRetainedRepository(), sessions, interceptor, rights, loops);
            this.sessions = sessions;
            this.rights = rights;
            this.exists = access.exists();
        }

        @Override
        public void fireWill(Session.Will will) {
            if (rights.canWrite(new Topic(will.topic), sessions.owners.get(will), null)) {
                super.fireWill(will);
            }
        }

        @Override
        CompletableFuture<Void> receivedPublishQos0(
                Topic topic, String user, String client, MqttPublishMessage message) {
            if (rights.canWrite(topic, user, client)) {
                return super.receivedPublishQos0(topic, user, client, message);
            }
            ReferenceCountUtil.release(message);
            return CompletableFuture.completedFuture(null);
        }

        @Override
        RoutingResults receivedPublishQos1(
                MQTTConnection from, Topic topic, String user, int id, MqttPublishMessage message) {
            return rights.canWrite(topic, user, from.getClientId())
                    ? super.receivedPublishQos1(from, topic, user, id, message)
                    : refuse(from, user, message, () -> from.sendPubAck(id));
        }

        @Override
        RoutingResults receivedPublishQos2(MQTTConnection from, MqttPublishMessage message, String user) {
            Topic topic = new Topic(message.variableHeader().topicName());
            int id = message.variableHeader().packetId();
            return rights.canWrite(topic, user, from.getClientId())
                    ? super.receivedPublishQos2(from, message, user)
                    : refuse(from, user, message, () -> from.sendPubRec(id));
        }

        /** A removed user should send the message again with another account, so it is not acknowledged. */
        private RoutingResults refuse(
                MQTTConnection from, String user, MqttPublishMessage message, Runnable acknowledgment) {
            if (user != null && exists.test(user)) {
                acknowledgment.run();
            } else {
                from.dropConnection();
            }
            ReferenceCountUtil.release(message);
            return RoutingResults.preroutingError();
        }
    }
}
