package io.furrow.soak.control;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.List;
import java.util.Properties;

import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.model.device.FarmSecret;
import io.furrow.simulators.host.DeviceHost;
import io.furrow.simulators.host.HostSettings;
import io.furrow.simulators.mqtt.MqttAccess;

/**
 * Starts two control planes as processes and their environment: Kafka as a process, Mosquitto, context broker, IoT
 * Agent and webhook behind proxies, and a host of simulated devices.
 */
final class ChaosFarm implements AutoCloseable {
    private static final Duration START_TIMEOUT = Duration.ofSeconds(120);

    private final Deque<AutoCloseable> parts = new ArrayDeque<>();
    final KafkaProcess kafka;
    final MosquittoProcess mosquitto;
    private final FiwareStandIn fiware;
    final FaultProxy contextBroker;
    final FaultProxy iotAgent;
    /** The server behind {@link #webhook}. */
    final AlarmReceiver receiver;

    final FaultProxy webhook;
    final FarmSecret secret;
    final List<ControlProcess> controls = new ArrayList<>();

    /** Starts everything; returns once both control planes are ready. */
    static ChaosFarm start(Path folder) throws Exception {
        ChaosFarm farm = new ChaosFarm(folder);
        boolean complete = false;
        try {
            farm.startControls(folder);
            complete = true;
            return farm;
        } finally {
            if (!complete) {
                farm.close();
            }
        }
    }

    private ChaosFarm(Path folder) throws Exception {
        kafka = part(new KafkaProcess(folder));
        kafka.start();
        mosquitto = part(new MosquittoProcess(folder.resolve("mosquitto")));
        mosquitto.start();
        fiware = part(FiwareStandIn.start(
                new FiwareSettings(0, 0, mosquitto.uri(), MosquittoProcess.AGENT, MosquittoProcess.AGENT_PASSWORD)));
        contextBroker = part(new FaultProxy(fiware.contextBroker()));
        iotAgent = part(new FaultProxy(fiware.iotAgent()));
        receiver = part(new AlarmReceiver());
        webhook = part(new FaultProxy(receiver.uri()));
        secret = FarmSecret.read(ControlPlaneOptions.secret(folder));
    }

    private <T extends AutoCloseable> T part(T part) {
        parts.push(part);
        return part;
    }

    private void startControls(Path folder) throws IOException {
        List<String> options = ControlPlaneOptions.provisioning(folder, contextBroker.uri(), iotAgent.uri());
        options.addAll(ControlPlaneOptions.accounts(mosquitto));
        options.addAll(ControlPlaneOptions.webhook(webhook.uri()));
        options.addAll(List.of("--standby-replicas", "1"));
        for (String name : List.of("control-a", "control-b")) {
            ControlProcess control = part(new ControlProcess(
                    folder, name, new ControlProcess.Settings(kafka.bootstrapServers(), "512m", options)));
            control.start();
            controls.add(control);
        }
        Until.isTrue(
                "both control planes are ready",
                START_TIMEOUT,
                () -> controls.stream().allMatch(each -> !each.isAlive() || each.isReady()));
        if (!controls.stream().allMatch(ControlProcess::isAlive)) {
            throw new IOException("a control plane ended while it started; see the files *.out in " + folder);
        }
        Properties client = new Properties();
        client.setProperty("bootstrap.servers", kafka.bootstrapServers());
        MqttAccess mqtt = new MqttAccess(mosquitto.uri(), null, 1);
        part(DeviceHost.start(HostSettings.of(client, mqtt, fiware.contextBroker(), () -> secret)));
    }

    /** The IoT Agent without the proxy {@link #iotAgent}. */
    URI directAgent() {
        return fiware.iotAgent();
    }

    @Override
    public void close() {
        while (!parts.isEmpty()) {
            try {
                parts.pop().close();
            } catch (Exception e) { // the other parts must still be stopped
                System.out.println("a part of the farm could not be stopped: " + e);
            }
        }
    }
}
