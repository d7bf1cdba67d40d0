package io.furrow.launcher.command;

import java.net.URI;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.HelpOption;
import io.furrow.cli.option.HttpUriConverter;
import io.furrow.launcher.option.FarmOptions;
import io.furrow.launcher.option.FiwareAccessOptions;
import io.furrow.launcher.option.ListenOptions;
import io.furrow.launcher.option.SuiteOptions;
import io.furrow.launcher.suite.SuiteSettings;
import io.furrow.model.file.AccessToken;

/** {@code ./furrow up}. */
@Command(
        name = "up",
        abbreviateSynopsis = true,
        description =
                "Starts everything in one JVM on 127.0.0.1 for real devices, also with an existing context broker "
                        + "and Kafka.")
public final class UpCommand implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Mixin
    private SuiteOptions options;

    @Option(
            names = "--orion",
            paramLabel = "URL",
            converter = HttpUriConverter.class,
            description =
                    "Use this context broker, for instance http://127.0.0.1:1026, and start neither the stand-in nor an "
                            + "MQTT broker. It must reach the listener for notifications.")
    private URI orion;

    @Option(names = "--kafka", paramLabel = "HOST:PORT", description = "Use this Kafka and start no broker.")
    private String kafka;

    @Mixin
    private FiwareAccessOptions access;

    @Mixin
    private ListenOptions listen;

    @Mixin
    private FarmOptions farm;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() throws Exception {
        AccessToken token = access.token();
        SuiteSettings.Farm settings = farm.farm(options.fiwareService, token);
        if (orion == null && settings.iotAgent() != null) {
            throw new CommandException("--iot-agent needs --orion: the stand-in of the context broker has its own.");
        }
        if (orion != null && farm.simulatesNowhere()) {
            throw new CommandException(
                    "--simulate-devices with --orion needs --mqtt: the broker to which simulated devices publish.");
        }
        SuiteSettings.Fiware fiware = new SuiteSettings.Fiware(
                access.scope(options.fiwareService),
                access.tokenFile,
                access.tokenHeader,
                token,
                listen.listening(orion));
        return new Session(spec.commandLine().getOut())
                .run(options.settings(orion, kafka, settings, fiware), options.data, suite -> () -> {});
    }
}
