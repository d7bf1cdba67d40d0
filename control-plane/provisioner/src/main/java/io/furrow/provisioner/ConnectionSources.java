package io.furrow.provisioner;

import java.util.List;

import io.furrow.provisioner.account.LoginReports;

/**
 * Who knows how devices are connected.
 *
 * @param logins of the MQTT brokers
 * @param measures of the IoT Agent
 */
public record ConnectionSources(List<LoginReports> logins, MeasureReports measures) {
    public static final ConnectionSources NONE = new ConnectionSources(List.of(), MeasureReports.NONE);
}
