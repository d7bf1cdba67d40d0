package io.furrow.provisioner;

import java.util.List;

import io.furrow.provisioner.account.LoginReports;

/**
 * Sources of reports about the connections of devices.
 *
 * @param logins of the MQTT brokers
 * @param measures of the IoT Agent
 */
public record ConnectionSources(List<LoginReports> logins, MeasureReports measures) {
    public static final ConnectionSources NONE = new ConnectionSources(List.of(), MeasureReports.NONE);
}
