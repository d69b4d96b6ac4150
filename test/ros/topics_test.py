#!/usr/bin/python3
"""The topics of a replay: in the fixed frame, stamped in the log's time, finite, steady in their ids, and the model of
the barge moves with the opening."""
import math
import os
import struct
import sys
import unittest

import rospy
import rostest
from geocontainer_mpm.msg import GeotextileForces, ReleaseStatus
from geometry_msgs.msg import PolygonStamped
from sensor_msgs.msg import JointState, PointCloud2
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from node_test import NodeDiagnostics  # noqa: E402

TOPICS = {"container_shape": PolygonStamped, "geotextile_forces": GeotextileForces, "geotextile_markers": MarkerArray,
          "soil_particles": PointCloud2, "release_status": ReleaseStatus, "hull_joint_states": JointState,
          "/tf": TFMessage}


class TopicsTest(unittest.TestCase):
    def test_topics(self):
        received = {topic: [] for topic in TOPICS}
        for topic, kind in TOPICS.items():
            rospy.Subscriber(topic, kind, received[topic].append, queue_size=100)
        diagnostics = NodeDiagnostics()
        diagnostics.wait_for_state("finished", limit_s=40.0)
        diagnostics.wait(lambda _: all(received.values()), 5.0, "a message of each topic")

        for topic in ("container_shape", "geotextile_forces", "soil_particles", "release_status"):
            self.assertGreater(len(received[topic]), 5, topic)
            stamped = [m for m in received[topic] if m.header.stamp.to_sec() > 1.75e9]
            self.assertTrue(stamped, topic)
            for message in stamped[2:]:  # the first may be older than the first transform
                self.assertEqual(message.header.frame_id, "map", topic)
        self.shape(received)
        self.forces(received["geotextile_forces"][-1])
        self.cloud(received["soil_particles"][-1])
        self.markers(received["geotextile_markers"])
        status = received["release_status"][-1]
        self.assertEqual(status.outcome, ReleaseStatus.RELEASING)
        self.assertFalse(status.stopped)
        self.assertGreater(status.port, 0.01)
        self.assertGreater(status.peak_tension, 0.0)
        self.assertLess(status.centroid.z, -1.0)
        self.model(received)

    def shape(self, received):
        """The outline lies around the hopper, rolled with the barge: not every point is in the plane x = 0."""
        points = received["container_shape"][-1].polygon.points
        self.assertGreater(len(points), 50)
        for point in points:
            self.assertTrue(math.isfinite(point.x) and abs(point.x) < 0.5 and abs(point.y) < 6.0, point)
            self.assertTrue(-6.0 < point.z < 1.0, point)
        self.assertTrue(any(abs(point.x) > 1e-4 for point in points), "pitch of the barge is missing")

    def forces(self, forces):
        self.assertEqual(forces.name, "container")
        self.assertEqual(len(forces.nodes), len(forces.tension))
        self.assertEqual(len(forces.nodes), len(forces.utilisation))
        self.assertTrue(all(math.isfinite(t) and t >= 0.0 for t in forces.tension))
        self.assertAlmostEqual(max(forces.utilisation), max(forces.tension) / forces.seam_strength, 12)
        self.assertAlmostEqual(forces.seam_strength, 0.85 * forces.strength, 3)

    def cloud(self, cloud):
        self.assertEqual([field.name for field in cloud.fields], ["x", "y", "z", "speed", "mean_stress"])
        self.assertGreater(cloud.width * cloud.height, 500)
        for i in range(cloud.width * cloud.height):
            values = struct.unpack_from("<5f", cloud.data, i * cloud.point_step)
            self.assertTrue(all(map(math.isfinite, values)))

    def markers(self, arrays):
        """The same ids and vertex counts in every array, so that rviz updates in place."""
        def signature(array):
            return [(m.ns, m.id, m.type, len(m.points), len(m.colors)) for m in array.markers]
        for array in arrays:
            self.assertEqual(signature(array), signature(arrays[0]))
            for marker in array.markers:
                self.assertEqual(marker.lifetime.to_sec(), 0.0)
                self.assertAlmostEqual(sum(q * q for q in (marker.pose.orientation.x, marker.pose.orientation.y,
                                                           marker.pose.orientation.z, marker.pose.orientation.w)), 1.0, 6)
        self.assertIn("legend", [m.ns for m in arrays[0].markers])

    def model(self, received):
        """robot_state_publisher turns the halves outwards, port about +x and starboard about -x, by the opening."""
        joints = received["hull_joint_states"][-1]
        self.assertEqual(joints.name, ["hull_port_joint", "hull_starboard_joint"])
        turned = {}
        for message in received["/tf"]:
            for transform in message.transforms:
                if transform.header.frame_id == "base_link":
                    q = transform.transform.rotation
                    turned[transform.child_frame_id] = max(turned.get(transform.child_frame_id, 0.0),
                                                           abs(2.0 * math.atan2(q.x, q.w)))
                    sign = 1.0 if transform.child_frame_id == "hull_port" else -1.0
                    self.assertGreaterEqual(sign * q.x, 0.0, transform.child_frame_id)
        self.assertGreater(turned["hull_port"], 0.8 * joints.position[0])
        self.assertGreater(turned["hull_starboard"], 0.8 * joints.position[1])


if __name__ == "__main__":
    rospy.init_node("topics_test")
    rostest.rosrun("geocontainer_mpm", "topics_test", TopicsTest)
