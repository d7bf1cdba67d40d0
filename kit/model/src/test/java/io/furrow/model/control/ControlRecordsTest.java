package io.furrow.model.control;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.MissionDeviceList;
import io.furrow.model.device.SecretFingerprints;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/**
 * Checks that records of {@code service.*} are written as they were read, with all members and without optional ones.
 */
class ControlRecordsTest {
    @ParameterizedTest
    @CsvSource(delimiter = ';', quoteCharacter = '"', textBlock = """
            replay; {'replay':'m.0a1b2c3d','mission':'m','topic':'data.m.replay.0a1b2c3d','group':'0a1b2c3d','source':{'topic':'data.raw'},'from':1,'to':9,'loop':true,'devices':['a','b'],'maxGap':'PT1.5S','stamps':'now','startAt':7,'analytics':['collision','temperature'],'speed':2.5,'range':{'from':2,'to':3},'wanted':'paused','seek':{'to':4,'sequence':5},'step':{'total':-1,'sequence':6},'clock':{'at':8,'shows':9},'created':10,'sequence':11}
            replay; {'replay':'m.0a1b2c3d','mission':'m','topic':'data.m.replay.0a1b2c3d','source':{'file':'x.mcap'},'loop':false,'speed':'max','wanted':'running','created':10,'sequence':11}
            replay; {'replay':'m.0a1b2c3d','mission':'m','topic':'data.m.replay.0a1b2c3d','loop':false,'speed':1000.0,'wanted':'stopped','created':0,'sequence':1}
            replay-status; {'sequence':7,'state':'ended','reason':'r','settled':false,'progress':{'epoch':1,'position':2,'from':3,'to':4,'offset':5,'lateness':6,'slip':7,'rate':17.5,'events':8,'primes':9,'skipped':10,'waiting':'w'}}
            replay-status; {'sequence':7,'state':'running','progress':{'epoch':0,'position':0,'from':0,'to':0,'offset':0,'lateness':0,'slip':0,'rate':0.0,'events':0,'primes':0,'skipped':0}}
            replay-status; {'sequence':7,'state':'stopped','settled':true}
            device-status; {'sequence':1,'state':'failed','reason':'r'}
            device-status; {'sequence':1,'state':'running'}
            connection; {'since':1,'loggedIn':2,'refusedLogin':{'count':3,'last':4,'reason':'wrong-password','user':'u'},'foreignTopic':{'count':5,'last':6,'topic':'t'},'unreadablePayload':{'count':7,'last':8,'reason':'r','payload':'p'},'registered':true}
            connection; {}
            recording; {'mission':'weeding','first':1000,'last':2000,'events':5}
            template; {'template':'t','version':2,'description':'d','devices':['a',{'type':'Robot','count':2,'speed':1.50}]}
            template; {'template':'t','devices':[]}
            device; {'id':'a','service':'farm','servicePath':'/','domain':'d','mission':'m','from':1,'until':2,'sequence':3,'carriedBy':'b','stationary':true,'type':'T','device':'x','simulated':true,'wanted':'stopped','period':'PT0.5S','settings':{'speed':1.50},'generation':4}
            device; {'id':'a','service':'','servicePath':'/','domain':'','mission':'','from':1,'sequence':3,'wanted':'running'}
            device; {'id':'a','service':'','servicePath':'/','domain':'','mission':'','from':1,'sequence':3,'type':'T','device':'x','simulated':false,'wanted':'running','group':{'part':1,'index':2,'member':3,'sequence':4}}
            version; {'id':'a','service':'farm','servicePath':'/','domain':'d','mission':'m','from':1,'until':2,'sequence':3,'carriedBy':'b','stationary':true}
            list; {'mission':'m','part':0,'sequence':7,'devices':['a',{'type':'T','speed':1.50}]}
            fault; {'text':'t'}
            fault; {'text':'t','code':'c','values':{'a':'1'}}
            secret; {'newest':10,'apiKeys':1,'fingerprints':{'1':'a','2':'b','10':'c'}}
            """)
    void writesRecordsAsTheyWereRead(String kind, String record) throws Exception {
        String json = record.replace('\'', '"');
        byte[] value = json.getBytes(UTF_8);
        byte[] written = switch (kind) {
            case "replay" -> DesiredReplay.read(value).toBytes();
            case "replay-status" -> ReplayStatus.read(value).toBytes();
            case "device-status" -> DeviceStatus.read(value).toBytes();
            case "connection" -> DeviceConnection.read(value).toBytes();
            case "recording" -> RecordedMission.read(value).toBytes();
            case "template" -> MissionTemplate.read(value).toBytes();
            case "device" -> DesiredDevice.read(value).toBytes();
            case "version" -> DeviceVersion.read(value).toBytes();
            case "list" -> MissionDeviceList.read(value).toBytes();
            case "fault" -> Fault.read(value).toBytes();
            default -> SecretFingerprints.read(value).toBytes();
        };
        assertThat(new String(written, UTF_8)).isEqualTo(json);
    }
}
