#!/usr/bin/env python3
"""Devices of a farm that use only an MQTT client and their row of the credentials.

  device_programs.py CREDENTIALS BEHAVIOR EVENTS

CREDENTIALS is the output of './furrow device credentials --output csv', read again when the broker rejects a login. BEHAVIOR has a line
of JSON per device: its values, period, place and fault. Connections, commands and reports are appended to EVENTS, one line of JSON each.
"""
import csv
import heapq
import json
import math
import sys
import threading
import time

import paho.mqtt.client as mqtt

METERS_PER_DEGREE = math.pi / 180 * 6371000
STORED_EVERY = 0.5
MAX_PAUSE = 5


def now():
    return int(time.time() * 1000)


class Events:
    def __init__(self, path):
        self.file = open(path, "a", buffering=1)
        self.lock = threading.Lock()

    def write(self, device, event, **members):
        with self.lock:
            self.file.write(json.dumps({"at": now(), "device": device, "event": event, **members}) + "\n")


class Device:
    def __init__(self, behavior, rows, events):
        self.behavior, self.rows, self.events = behavior, rows, events
        self.id = behavior["device"]
        self.connected, self.stored, self.sent = False, behavior.get("stored", 0), 0
        row = rows(self.id)
        self.client = mqtt.Client(mqtt.CallbackAPIVersion.VERSION2, client_id=row["deviceId"], clean_session=False)
        self.client.reconnect_delay_set(1, MAX_PAUSE)
        self.client.on_connect, self.client.on_disconnect = self.on_connect, self.on_disconnect
        self.client.on_message = self.on_message
        self.use_login(row)
        self.client.connect_async(row["host"], int(row["port"]))

    def use_login(self, row):
        self.row = row
        wrong = self.behavior.get("fault") == "password"
        self.client.username_pw_set(row["user"], row["password"] + ("x" if wrong else ""))

    def on_connect(self, client, _, __, reason, ___):
        self.connected = not reason.is_failure
        self.events.write(self.id, "connected" if self.connected else "refused", user=self.row["user"])
        if self.connected:
            client.subscribe(self.row["commands"], qos=1)
        else:
            self.use_login(self.rows(self.id))  # the credentials may have been rotated

    def on_disconnect(self, client, _, __, reason, ___):
        if self.connected:
            self.connected = False
            self.events.write(self.id, "cut", user=self.row["user"])

    def on_message(self, client, _, message):
        command = json.loads(message.payload)
        self.events.write(self.id, "asked", command=list(command))
        client.publish(self.row["results"], json.dumps({name: "done" for name in command}), qos=1)
        self.report(now())

    def report(self, at):
        behavior, names = self.behavior, self.behavior["names"]
        measure = {"time": at + behavior.get("ahead", 0)}
        if "value" in behavior:
            measure[names["Temperature"]] = round(behavior["value"] + 0.01 * (self.sent % 20), 2)
        position = self.position(at)
        if position:
            measure[names["Latitude"]], measure[names["Longitude"]] = position
        self.sent += 1
        topic, payload = self.row["measures"], json.dumps(measure)
        if behavior.get("fault") == "topic":
            topic = "/of-another" + topic[topic.index("/", 1):]
        if behavior.get("fault") == "json":
            payload = payload[:-1]
        self.events.write(self.id, "sent", time=measure["time"], value=measure.get(names["Temperature"]), position=position)
        self.client.publish(topic, payload, qos=1)

    def position(self, at):
        place, path = self.behavior.get("place"), self.behavior.get("path")
        if not place or not path:
            return place
        meters = path["from"] + path["swing"] * abs(math.sin(math.pi * (at / 1000 % path["seconds"]) / path["seconds"]))
        return [place[0], place[1] + meters / (METERS_PER_DEGREE * math.cos(math.radians(place[0])))]

    def step(self):
        """Reports if connected, and returns the seconds until the next step."""
        if not self.connected and (self.sent == 0 or self.stored > 0):
            return STORED_EVERY
        period = self.behavior["period"]
        if self.stored > 0:  # measured before the connection
            self.report(now() - int(self.stored * period * 1000))
            self.stored -= 1
            return STORED_EVERY
        self.report(now())
        return period


def run(credentials, behavior, events):
    def rows(device):
        with open(credentials, newline="") as file:
            return next(row for row in csv.DictReader(file) if row["device"] == device)

    log = Events(events)
    with open(behavior) as file:
        devices = [Device(json.loads(line), rows, log) for line in file]
    due = [(time.monotonic() + number / len(devices), number) for number in range(len(devices))]
    heapq.heapify(due)
    for device in devices:
        device.client.loop_start()
    while True:
        at, number = heapq.heappop(due)
        time.sleep(max(0.0, at - time.monotonic()))
        pause = devices[number].step()
        heapq.heappush(due, (max(at + pause, time.monotonic()), number))


run(*sys.argv[1:])
