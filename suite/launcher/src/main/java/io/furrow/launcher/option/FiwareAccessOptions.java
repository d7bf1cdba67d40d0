package io.furrow.launcher.option;

import java.io.IOException;
import java.nio.file.Path;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;
import picocli.CommandLine.Option;

import io.furrow.cli.option.CommandException;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.file.AccessToken;

/** Options for existing FIWARE servers: service path and token. */
public final class FiwareAccessOptions {
    private static final Logger LOG = LoggerFactory.getLogger(FiwareAccessOptions.class);

    @Option(
            names = "--fiware-service-path",
            paramLabel = "PATH",
            description =
                    "Service path of the missions' devices at the context broker and the IoT Agent. Of up, also the one, with "
                            + "those below, whose changes are notified. Default: ${DEFAULT-VALUE}.")
    private String servicePath = "/";

    @Option(
            names = "--fiware-token-file",
            paramLabel = "FILE",
            description =
                    "File whose first line is a token for the proxy in front of --orion and --iot-agent, sent with every "
                            + "request. Read again when it changes. Default: no token.")
    public Path tokenFile;

    @Option(
            names = "--fiware-token-header",
            paramLabel = "NAME",
            description = "Header of that token; most proxies use Authorization with a token 'Bearer …'. Default: "
                    + AccessToken.DEFAULT_HEADER + ", as for a Wilma PEP proxy.")
    public String tokenHeader;

    /** @throws CommandException if the path is invalid */
    public FiwareScope scope(String fiwareService) {
        if (!servicePath.matches("/|(/[A-Za-z0-9_]{1,50}){1,10}")) {
            throw new CommandException(
                    "--fiware-service-path %s is none: name '/' or up to ten parts of letters, digits and _, as /farm/north."
                            .formatted(servicePath));
        }
        return FiwareScope.of(fiwareService, servicePath);
    }

    /** @throws CommandException if the file holds no token */
    public AccessToken token() {
        if (tokenFile == null) {
            if (tokenHeader != null) {
                throw new CommandException("--fiware-token-header needs --fiware-token-file.");
            }
            return AccessToken.NONE;
        }
        try {
            return AccessToken.of(tokenFile, tokenHeader, LOG::warn);
        } catch (IOException e) {
            throw new CommandException("--fiware-token-file: %s.".formatted(e.getMessage()), e);
        }
    }
}
