package io.furrow.launcher.option;

import java.io.IOException;
import java.net.InetAddress;
import java.net.NetworkInterface;
import java.net.SocketException;
import java.net.URI;
import java.net.UnknownHostException;
import java.nio.file.Path;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;
import picocli.CommandLine.Option;

import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.HttpUriConverter;
import io.furrow.launcher.suite.SuiteSettings;
import io.furrow.model.file.AccessToken;

/** Options of {@code up} that give a context broker and devices on other computers access. */
public final class ListenOptions {
    private static final Logger LOG = LoggerFactory.getLogger(ListenOptions.class);

    @Option(
            names = "--listen",
            paramLabel = "ADDRESS",
            description =
                    "Address of the listener for notifications; another than this machine's needs --notify-secret and --listen-insecure. "
                            + "Default: ${DEFAULT-VALUE}.")
    private String listen = "127.0.0.1";

    @Option(
            names = "--public-url",
            paramLabel = "URL",
            converter = HttpUriConverter.class,
            description =
                    "URL by which the context broker reaches that listener, for instance http://farm.lan:8090/v2/notify. "
                            + "Default: its address and port.")
    private URI publicUrl;

    @Option(
            names = "--notify-secret",
            paramLabel = "FILE",
            description =
                    "File whose first line is a secret that each notification must have; the suite's own subscriptions "
                            + "send it. A second line is also accepted, for a rotation.")
    private Path secret;

    @Option(
            names = "--mqtt-listen",
            paramLabel = "ADDRESS",
            description =
                    "Address of the suite's MQTT broker; another than this machine's needs --listen-insecure. Default: ${DEFAULT-VALUE}.")
    private String mqttListen = "127.0.0.1";

    @Option(
            names = "--listen-insecure",
            description =
                    "Allow --listen and --mqtt-listen to use addresses that other machines reach without TLS: the "
                            + "network is trusted, or a proxy in front terminates TLS.")
    private boolean insecure;

    /**
     * @param orion null for the stand-in
     * @throws CommandException if the addresses are unreachable, or open to everyone
     */
    public SuiteSettings.Listening listening(URI orion) {
        boolean open = !isLoopback("--listen", listen);
        if (open && secret == null) {
            throw new CommandException(
                    "--listen %s lets anyone who reaches it report in the name of the context broker: name a file with a secret with --notify-secret, or keep to 127.0.0.1."
                            .formatted(listen));
        }
        boolean mqttOpen = !isLoopback("--mqtt-listen", mqttListen);
        if (mqttOpen && orion != null) {
            throw new CommandException(
                    "--mqtt-listen is of the suite's own MQTT broker, which is not started with --orion.");
        }
        if ((open || mqttOpen) && !insecure) {
            throw new CommandException(
                    "%s lets other machines in without TLS: secrets and passwords would pass in the clear. Say with --listen-insecure that the network is trusted or a proxy in front ends TLS, or keep to 127.0.0.1."
                            .formatted(open ? "--listen " + listen : "--mqtt-listen " + mqttListen));
        }
        if (publicUrl == null && orion != null) {
            requireReachable(orion, open);
        }
        requireSecret();
        return new SuiteSettings.Listening(listen, publicUrl, secret, mqttListen);
    }

    /** Checked early: the connector reads it after all else has started. */
    private void requireSecret() {
        try {
            if (secret != null) {
                AccessToken.of(secret, null, LOG::warn);
            }
        } catch (IOException e) {
            throw new CommandException("--notify-secret: %s.".formatted(e.getMessage()), e);
        }
    }

    private void requireReachable(URI orion, boolean open) {
        if (open && address("--listen", listen).isAnyLocalAddress()) {
            throw new CommandException(
                    "--listen %s is every address of this machine: say with --public-url which of them the context broker reaches, as http://farm.lan:8090/v2/notify."
                            .formatted(listen));
        }
        if (!open && !isOfThisMachine(orion.getHost())) {
            throw new CommandException(
                    "The context broker of --orion %s is on another machine and cannot reach the listener for notifications on %s. Listen with --listen on an address that it reaches, or name with --public-url a proxy that leads here."
                            .formatted(orion, listen));
        }
    }

    private static boolean isLoopback(String option, String host) {
        return address(option, host).isLoopbackAddress();
    }

    private static InetAddress address(String option, String host) {
        try {
            return InetAddress.getByName(host);
        } catch (UnknownHostException e) {
            throw new CommandException("%s %s is not an address of this machine.".formatted(option, host), e);
        }
    }

    /** True for an unknown host: a later check reports that it does not answer. */
    private static boolean isOfThisMachine(String host) {
        try {
            InetAddress address = InetAddress.getByName(host);
            return address.isLoopbackAddress() || NetworkInterface.getByInetAddress(address) != null;
        } catch (UnknownHostException | SocketException e) {
            return true;
        }
    }
}
